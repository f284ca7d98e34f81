// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/units.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What a wall is made of, and so what it takes from a signal that passes through.
///
/// A material that gives no loss of its own follows the propagation model's (its wall factor).
struct Material {
    std::string name = "wall";
    std::optional<Db> per_crossing = std::nullopt;       ///< [dB] whatever the length inside
    std::optional<DbPerMeter> per_metre = std::nullopt;  ///< [dB/m] of length inside, >= 0
    std::optional<ItuMaterial> slab = std::nullopt;      ///< a slab of this, whatever is drawn ...
    Meters thickness{0};                                 ///< ... and its thickness [m], > 0
    Meters height{std::numeric_limits<double>::infinity()};  ///< [m] the wall stands from 0 to here

    bool follows_model() const { return !per_crossing && !per_metre && !slab; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// What one crossing of a wall takes at one frequency.
struct WallRate {
    double per_crossing = 0;  ///< [dB]
    double per_metre = 0;     ///< [dB/m]
};

/// What crossings of walls take, by the walls' drawn thickness.
struct WallRates {
    std::vector<WallRate> light;  ///< by material, of walls that are thinner than ...
    std::vector<WallRate> heavy;  ///< by material, of others
    Meters thinnest_heavy;        ///< ... this [m]
};

/// The rate of `material` at `frequency`; one that follows the model takes `usual_per_metre`
/// [dB/m].
WallRate wall_rate(const Material& material, Hertz frequency, double usual_per_metre);

}  // namespace rovernet
