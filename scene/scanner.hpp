// SPDX-License-Identifier: MIT
#pragma once

#include "scene/range_finder.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Pose (position and direction) in the horizontal plane, of a beam, a scanner or a robot. Its
/// coordinate frame is that of the scanner, of the robot or of the world.
struct ScannerPose {
    Vec3 at = {};          ///< position [m]; x ahead and y to the left in the frame of a robot
    Radians heading = {};  ///< direction [rad], counter-clockwise from the x axis
};

/// Composition of poses: `inner` is given in the frame of `outer`; the result is in the parent
/// frame of `outer`.
ScannerPose operator*(const ScannerPose& outer, const ScannerPose& inner);

/// Range finder mounted on a robot. The beams form a fan from one point of the robot, or a ring: a
/// set of single beams, such as sonars, each with a direction and a position:
///
///   scan = [{ kind = "laser", at = ["0.1 m", "0 m"], beams = 181 },
///           { kind = "sonar", angles = ["90 deg", "-90 deg"], places = [["0 m", "0.1 m"], ...] }]
struct Scanner {
    RangeFinder finder = {};  ///< kind, range and period of measuring; also the beams of a fan
    std::string name = {};    ///< name of the scanner; empty: the name of its kind
    Vec3 at = {};             ///< position in the frame of the robot [m]
    Radians heading = {};     ///< direction from the robot's heading [rad]
    std::vector<Radians> angles = {};  ///< beam directions of a ring, from `heading` [rad]
    /// Starting points of the beams of a ring, relative to `at` [m]; empty: `at` for all beams.
    std::vector<Vec3> places = {};

    bool is_ring() const { return !angles.empty(); }
    /// Name of the scanner for client programs: `name`, or the name of its kind if `name` is empty.
    std::string label() const;
    /// Number of beams.
    std::size_t size() const;
    /// Pose of the scanner in the frame of its robot.
    ScannerPose pose() const { return {at, heading}; }
    /// Pose of a beam in the frame of the scanner; beams are numbered from 0.
    ScannerPose beam(std::size_t number) const;

    /// Measures the distance along each beam to the nearest wall or body, see RangeFinder::measure.
    /// @param robot   pose of the robot in the world
    /// @param bodies  bodies of the other robots
    /// @param out     distance of each beam [m]
    /// @throws std::invalid_argument if the size of `out` is not the number of beams
    void measure(const Scene& scene, const ScannerPose& robot, std::span<const RoundBody> bodies,
                 std::span<double> out) const;

    /// Parameters of a scanner, in addition to the parameters of `finder`.
    static constexpr auto fields() {
        return describe(
            field("name", &Scanner::name, "name of the range finder, for external programs"),
            field("at", &Scanner::at, "position of the range finder on the robot"),
            field("heading", &Scanner::heading, "direction of the range finder on the robot"),
            field("angles", &Scanner::angles,
                  "instead of `beams`, `from` and `to`: direction of each beam"),
            field("places", &Scanner::places,
                  "with `angles`: position at which each beam begins, relative to `at`"));
    }
};

}  // namespace rovernet
