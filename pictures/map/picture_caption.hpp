// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Caption of a picture: the lines above it. They say of a network the time, the robots that are
/// not there, the models, and of whom the coverage is.
/// @param end     of the scenario's run: a time after it is said to be so
/// @param source  whose coverage is drawn
std::vector<std::string> picture_caption(const Network& network, Time at, Time end,
                                         std::optional<NodeId> source);

}  // namespace rovernet
