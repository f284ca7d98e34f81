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

/// Type of device that a range finder appears as to external programs. All types measure in the
/// same way.
enum class RangeFinderKind { laser, sonar, ranger };
template <>
struct EnumNames<RangeFinderKind> {
    static constexpr std::array<std::string_view, 3> values = {"laser", "sonar", "ranger"};
};

/// Round body of a robot, as an obstacle for range finders.
struct RoundBody {
    Vec3 at;        ///< position of the robot [m]
    Meters radius;  ///< radius of the body [m], > 0
};

/// Range finder of a robot: beams from the robot's centre, evenly spread over an angle. Each beam
/// measures the exact distance, without noise, to the nearest wall or body:
///
///   scan = { kind = "laser", beams = 181, from = "-90 deg", to = "90 deg", range = "8 m" }
struct RangeFinder {
    RangeFinderKind kind = RangeFinderKind::laser;
    int beams = 181;                    ///< number of beams, 1 ... 10,000
    Radians from{-1.5707963267948966};  ///< direction of the first beam from the heading [rad]
    Radians to{1.5707963267948966};     ///< direction of the last beam from heading [rad], >= from
    Meters range{8};                    ///< largest measured distance [m]
    Duration every = Duration{100'000'000};  ///< time between two measurements [ns]

    /// Angle between two beams [rad]; 0 for one beam.
    Radians step() const;
    /// Angle of a beam from the robot's heading [rad]; beams are numbered from 0.
    Radians angle(int beam) const { return from + beam * step(); }

    /// Measures the distance along each beam to the nearest wall or body, in the horizontal plane
    /// at the height of `at`. A beam that starts in a wall or in a body measures 0.
    /// @param at, heading  pose of the robot
    /// @param bodies       bodies of the other robots
    /// @param out          receives the distance of each beam [m]; `range` if nothing is nearer
    /// @throws std::invalid_argument if the size of `out` is not the number of beams
    void measure(const Scene& scene, Vec3 at, Radians heading, std::span<const RoundBody> bodies,
                 std::span<double> out) const;

    static constexpr auto fields() {
        return describe(
            field("kind", &RangeFinder::kind, "kind of device that external programs see"),
            field("beams", &RangeFinder::beams,
                  Range{.low = 1, .high = 10'000, .text = "from 1 to 10,000"}, "number of beams"),
            field("from", &RangeFinder::from, whole_turn,
                  "direction of the first beam, counter-clockwise from the heading of the range "
                  "finder"),
            field("to", &RangeFinder::to, whole_turn,
                  "direction of the last beam, counter-clockwise from the heading of the range "
                  "finder; the beams are evenly spaced between `from` and `to`"),
            field("range", &RangeFinder::range, positive,
                  "longest distance that the range finder measures"),
            field("every", &RangeFinder::every, Range{.low = 1e-3, .text = ">= 1 ms"},
                  "time between two measurements"));
    }

  private:
    static constexpr Range whole_turn{
        .low = -6.283185307179587, .high = 6.283185307179587, .text = "from -360 to 360 degrees"};
};

}  // namespace rovernet
