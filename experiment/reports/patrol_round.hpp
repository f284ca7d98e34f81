// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_writer.hpp"
#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <optional>

namespace rovernet {

/// Last whole round of a robot that patrols: from the first place of its path, or from its start if
/// that is the last place of the path, by way of all other places to the same place. An earlier
/// round may be shorter: the robot may start with the right heading.
struct PatrolRound {
    std::size_t places;  ///< number of places of the path
    Time begin;
    Duration length;  ///< [ns], with the times for turning, and for waiting at doors
};

/// Last whole round of the robot that the track belongs to; none if its movement in the scenario is
/// not `patrol`, or if no round ends within the run.
std::optional<PatrolRound> patrol_round(const Scenario& scenario, const Track& track);

}  // namespace rovernet
