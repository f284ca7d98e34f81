// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"
#include "experiment/playing.hpp"
#include "mobility/files/movement_writer.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Positions of all robots at a time.
struct Whereabouts {
    struct Row {
        std::string name;
        Vec3 position;   ///< [m]
        Vec3 velocity;   ///< [m/s]
        double heading;  ///< [rad], -pi ... pi
        Presence presence;
    };
    Time time;
    std::vector<Row> robots;
};

/// Runs the scenario through all these times; the answers are in their order.
std::vector<Whereabouts> whereabouts(const Scenario& scenario, const std::vector<Time>& times,
                                     const TellTime& tell = {});

/// Legs of every robot in the scenario's run.
std::vector<Track> tracks(const Scenario& scenario, const TellTime& tell = {});

/// The scenario's motion as a movement file: NAME.movements (and NAME.params beside it) for
/// BonnMotion, NAME.tcl or NAME.ns_movements for ns-2.
/// @throws std::invalid_argument for another ending
std::vector<OutputFile> movement_files(const Scenario& scenario, const std::string& path,
                                       const TellTime& tell = {});

}  // namespace rovernet
