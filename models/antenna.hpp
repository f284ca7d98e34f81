// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

// Antennas: gain of a radio by direction. link_gain.hpp adds the gains to link budgets.

namespace rovernet {

/// Shape of an antenna pattern: gain [dB] relative to the strongest direction, at the angle phi
/// from that direction, in the horizontal plane. Height differences do not change the gain.
///
/// - isotropic: 0 dB everywhere
/// - cosine: 10 n log10((1 + cos phi) / 2), at least -front_to_back [dB]; the exponent n is chosen
///   so that the gain is -3 dB at half the beamwidth
/// - table: linear interpolation in dB between the points of a table, periodic
///
/// The cosine shape is cos(phi / 2) to the power 2 n, the sector antenna of C. Li, Efficient
/// Antenna Patterns for Three-Sector WCDMA Systems, Chalmers University of Technology, 2003.
/// Example: examples/antenna.cpp.
enum class AntennaShape { isotropic, cosine, table };
/// Names of the values of `antenna` in scenario files.
template <>
struct EnumNames<AntennaShape> {
    static constexpr std::array<std::string_view, 3> values = {"isotropic", "cosine", "table"};
};

/// Point of an antenna pattern that is given as a table.
struct PatternPoint {
    /// Angle from the antenna's direction, counter-clockwise [degrees].
    double degrees = 0;
    /// Gain relative to antenna_gain [dB], <= 0.
    double db = 0;

    friend bool operator==(const PatternPoint&, const PatternPoint&) = default;
};

/// Valid range of antenna beamwidths [rad].
inline constexpr Range beamwidths{
    .low = 0, .high = 6.28318, .low_included = false, .text = "> 0 deg and < 360 deg"};

}  // namespace rovernet
