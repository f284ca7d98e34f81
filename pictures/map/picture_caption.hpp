// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Caption of a picture, as lines above the picture: time, absent robots, models, and the robots
/// whose coverage is drawn.
/// @param end     end of the scenario's run; the caption states if `at` is later than `end`
/// @param storey  number of the drawn storey
/// @param sources   robots whose coverage is drawn
/// @param receiver  robot whose radio the receivers have; none: the radio of the first source
std::vector<std::string> picture_caption(const Network& network, Time at, Time end,
                                         std::size_t storey, const std::vector<NodeId>& sources,
                                         std::optional<NodeId> receiver = std::nullopt);

}  // namespace rovernet
