// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_file.hpp"
#include "network/network.hpp"
#include "sim/ids.hpp"

#include <vector>

namespace rovernet {

/// Moves robots along the trajectories of a movement file, from now on. A robot whose trajectory
/// starts later is switched off until its trajectory starts. A robot that gets another movement
/// while it is there, by Network::move(), place() or stop(), has left the file for good.
/// @param nodes  node of each robot of file.robots(), in the order of file.robots()
void play(Network& network, MovementFile file, std::vector<NodeId> nodes);

}  // namespace rovernet
