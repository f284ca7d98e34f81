// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/units.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Material of a wall, which determines its loss for a signal that passes through.
///
/// A material without a loss of its own has the loss of the propagation model (its wall factor).
struct Material {
    std::string name = "wall";
    /// Loss of each crossing [dB], for any length inside.
    std::optional<Db> per_crossing = std::nullopt;
    std::optional<DbPerMeter> per_metre = std::nullopt;  ///< loss by length inside [dB/m], >= 0
    std::optional<ItuMaterial> slab = std::nullopt;      ///< loss of a slab of this ITU material
    Meters thickness{0};  ///< thickness of that slab [m], > 0, independent of the drawn one
    Meters height{std::numeric_limits<double>::infinity()};  ///< height of the wall [m]

    bool follows_model() const { return !per_crossing && !per_metre && !slab; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// Loss of a crossing of one wall at one frequency.
struct WallRate {
    double per_crossing = 0;  ///< loss of a crossing [dB]
    double per_metre = 0;     ///< loss per metre inside [dB/m]
};

/// Losses of wall crossings for thin and thick walls, by drawn thickness.
struct WallRates {
    std::vector<WallRate> light;  ///< rates by material, for walls thinner than thinnest_heavy
    std::vector<WallRate> heavy;  ///< rates by material, for all other walls
    Meters thinnest_heavy;        ///< smallest thickness of a heavy wall [m]
};

/// Loss of `material` at `frequency`; a material that follows the propagation model has a loss of
/// `usual_per_metre` [dB/m].
WallRate wall_rate(const Material& material, Hertz frequency, double usual_per_metre);

}  // namespace rovernet
