// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_file.hpp"
#include "network/network.hpp"
#include "sim/ids.hpp"

#include <vector>

namespace rovernet {

/// Moves robots as the file says, from now on. A robot that appears later is off until then.
/// @param nodes  for each of file.robots(), in their order
void play(Network& network, MovementFile file, std::vector<NodeId> nodes);

}  // namespace rovernet
