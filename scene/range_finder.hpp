// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <span>
#include <string_view>

namespace rovernet {

/// Device that a range finder is for the programs of its robot. What it measures is the same.
enum class RangeFinderKind { laser, sonar, ranger };
template <>
struct EnumNames<RangeFinderKind> {
    static constexpr std::array<std::string_view, 3> values = {"laser", "sonar", "ranger"};
};

/// Body of a robot, as a range finder sees it.
struct RoundBody {
    Vec3 at;        ///< [m]
    Meters radius;  ///< > 0
};

/// Range finder of a robot: beams from its middle, evenly spread over an angle. Each measures
/// exactly, without noise, the way to the nearest wall or body:
///
///   scan = { kind = "laser", beams = 181, from = "-90 deg", to = "90 deg", range = "8 m" }
struct RangeFinder {
    RangeFinderKind kind = RangeFinderKind::laser;
    int beams = 181;                         ///< 1 ... 10,000
    Radians from{-1.5707963267948966};       ///< first beam, from the heading [rad]
    Radians to{1.5707963267948966};          ///< last beam [rad], not before the first
    Meters range{8};                         ///< farthest that it measures [m]
    Duration every = Duration{100'000'000};  ///< time between two measurements [ns]

    /// Angle between two beams [rad]; 0 for one beam.
    Radians step() const;
    /// Angle of a beam from the heading [rad].
    Radians angle(int beam) const { return from + beam * step(); }

    /// Measures, level at the height of `at`. A beam that begins in a wall or in a body measures 0.
    /// @param at, heading  of the robot
    /// @param bodies       of others
    /// @param out          [m], one for each beam, 0 ... range; range: nothing is nearer
    /// @throws std::invalid_argument if there is not one for each beam
    void measure(const Scene& scene, Vec3 at, Radians heading, std::span<const RoundBody> bodies,
                 std::span<double> out) const;

    static constexpr auto fields() {
        return describe(
            field("kind", &RangeFinder::kind, "device that it is for programs outside"),
            field("beams", &RangeFinder::beams,
                  Range{.low = 1, .high = 10'000, .text = "from 1 to 10,000"}, "how many"),
            field("from", &RangeFinder::from, whole_turn, "first beam, from the heading"),
            field("to", &RangeFinder::to, whole_turn,
                  "last beam, counter-clockwise from the first"),
            field("range", &RangeFinder::range, positive, "farthest that it measures"),
            field("every", &RangeFinder::every, Range{.low = 1e-3, .text = ">= 1 ms"},
                  "time between two measurements"));
    }

  private:
    static constexpr Range whole_turn{
        .low = -6.283185307179587, .high = 6.283185307179587, .text = "from -360 to 360 degrees"};
};

}  // namespace rovernet
