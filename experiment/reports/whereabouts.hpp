// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"
#include "experiment/playing.hpp"
#include "mobility/files/movement_writer.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Positions, velocities and headings of all robots at one time.
struct Whereabouts {
    struct Row {
        std::string name;
        Vec3 position;   ///< position [m]
        Vec3 velocity;   ///< velocity [m/s]
        double heading;  ///< heading [rad], -pi ... pi
        Presence presence;
    };
    Time time;
    std::vector<Row> robots;
};

/// Runs the scenario and returns the positions of all robots, or only of `robot` if it is given, at
/// each of the `times`, in the order of `times`.
/// @throws std::invalid_argument for an unknown robot
std::vector<Whereabouts> whereabouts(const Scenario& scenario, const std::vector<Time>& times,
                                     const std::optional<std::string>& robot = {},
                                     const TellTime& tell = {});

/// Runs the scenario and returns the pieces of movement (legs) of every robot.
std::vector<Track> tracks(const Scenario& scenario, const TellTime& tell = {});

/// Movement files with the movements of a scenario's robots. The ending of `path` selects the
/// format: NAME.movements and NAME.params for BonnMotion, NAME.tcl or NAME.ns_movements for ns-2.
/// @param notices  receives a notice if the robots have other names in the file
/// @throws std::invalid_argument for any other ending of `path`
std::vector<OutputFile> movement_files(const Scenario& scenario, const std::string& path,
                                       std::vector<std::string>& notices,
                                       const TellTime& tell = {});

}  // namespace rovernet
