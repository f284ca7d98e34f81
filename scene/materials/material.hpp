// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Material of a wall, which determines its loss for a signal that passes through.
///
/// If a material gives no loss, the propagation model gives the loss (by its wall factor).
struct Material {
    std::string name = "wall";
    /// Loss of each crossing of a wall [dB], independent of the length inside the wall.
    std::optional<Db> per_crossing = std::nullopt;
    std::optional<DbPerMeter> per_metre = std::nullopt;  ///< loss per length inside [dB/m], >= 0
    /// Material of ITU-R P.2040: the loss of a crossing is that of a slab of this material.
    std::optional<ItuMaterial> slab = std::nullopt;
    Meters thickness{0};  ///< thickness of the slab [m], > 0, independent of the drawn thickness
    Meters height{std::numeric_limits<double>::infinity()};  ///< height of the wall [m]

    bool follows_model() const { return !per_crossing && !per_metre && !slab; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// Loss of a crossing of one wall at one frequency.
struct WallRate {
    double per_crossing = 0;  ///< loss of a crossing [dB]
    double per_metre = 0;     ///< loss per metre inside [dB/m]
};

/// Tables of the losses of wall crossings by material: one for light (thin) walls, and one for
/// heavy (thick) walls. The drawn thickness of a wall determines its table.
struct WallRates {
    std::vector<WallRate> light;  ///< losses by material, of walls thinner than thinnest_heavy
    std::vector<WallRate> heavy;  ///< losses by material, of walls from thinnest_heavy on
    Meters thinnest_heavy;        ///< smallest drawn thickness of a heavy wall [m]
};

/// Loss of a wall of `material` at `frequency`. If the material gives no loss, the loss is
/// `usual_per_metre` [dB/m], the wall loss of the propagation model.
WallRate wall_rate(const Material& material, Hertz frequency, double usual_per_metre);

/// One passage of a segment a-b (the direct path between two points) through a wall.
struct Crossing {
    double entry;              ///< distance from the segment's start to the entry into the wall [m]
    double exit;               ///< distance from the segment's start to the exit of the wall [m]
    double length;             ///< exit - entry [m]; bitwise equal for the reversed segment
    std::size_t material = 0;  ///< material of the wall: index into Scene::materials()
    friend constexpr bool operator==(Crossing, Crossing) = default;
};

}  // namespace rovernet
