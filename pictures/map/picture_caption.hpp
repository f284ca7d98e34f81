// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Caption of a picture: the lines above it. They tell the time, the robots of the network that are
/// not there, the models, and the robot whose coverage is drawn.
/// @param end     end of the scenario's run: the caption tells that `at` is after it
/// @param storey  number of the storey that is drawn
/// @param source    robot whose coverage is drawn
/// @param receiver  robot whose radio receives it; none: one like the source's
std::vector<std::string> picture_caption(const Network& network, Time at, Time end,
                                         std::size_t storey, std::optional<NodeId> source,
                                         std::optional<NodeId> receiver = std::nullopt);

}  // namespace rovernet
