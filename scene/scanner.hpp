// SPDX-License-Identifier: MIT
#pragma once

#include "scene/range_finder.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Place and direction in the plane, in the frame of a scanner, of its robot or of the world.
struct ScannerPose {
    Vec3 at = {};          ///< [m] x ahead and y to the left, if the frame is a robot's
    Radians heading = {};  ///< counter-clockwise from the x axis
};

/// `inner`, given in the frame of `outer`, in the frame that `outer` is given in.
ScannerPose operator*(const ScannerPose& outer, const ScannerPose& inner);

/// Range finder as a robot carries it: a fan of beams from its place on the robot, or a ring of
/// single beams, such as sonars, each with a direction and a place of its own:
///
///   scan = [{ kind = "laser", at = ["0.1 m", "0 m"], beams = 181 },
///           { kind = "sonar", angles = ["90 deg", "-90 deg"], places = [["0 m", "0.1 m"], ...] }]
struct Scanner {
    RangeFinder finder = {};           ///< kind, range, time; and beams, unless it is a ring
    std::string name = {};             ///< empty: the word of its kind
    Vec3 at = {};                      ///< place in the frame of the robot [m]
    Radians heading = {};              ///< from the robot's heading [rad]
    std::vector<Radians> angles = {};  ///< ring: directions of its beams, from the heading [rad]
    std::vector<Vec3> places = {};  ///< ring: begins of its beams from `at` [m]; empty: all there

    bool is_ring() const { return !angles.empty(); }
    /// Name that programs find it by.
    std::string label() const;
    /// Number of beams.
    std::size_t size() const;
    /// Scanner in the frame of its robot.
    ScannerPose pose() const { return {at, heading}; }
    /// Beam in the frame of the scanner.
    ScannerPose beam(std::size_t number) const;

    /// Measures, as RangeFinder does.
    /// @param robot   in the world
    /// @param bodies  of other robots
    /// @param out     [m], one for each beam
    /// @throws std::invalid_argument if there is not one for each beam
    void measure(const Scene& scene, const ScannerPose& robot, std::span<const RoundBody> bodies,
                 std::span<double> out) const;

    /// Parameters beside those of `finder`.
    static constexpr auto fields() {
        return describe(field("name", &Scanner::name, "name that programs find it by"),
                        field("at", &Scanner::at, "place on the robot"),
                        field("heading", &Scanner::heading, "direction on the robot"),
                        field("angles", &Scanner::angles, "ring: directions of its beams"),
                        field("places", &Scanner::places, "ring: begins of its beams"));
    }
};

}  // namespace rovernet
