// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <cstdint>

// Detection of colliding traffic: messages of several robots that start at the same time.

namespace rovernet {

/// Shortest time [ns] between the starts of two frames at which the frames do not collide; 0 if
/// frames never collide. After this time, under csma the second sender senses the first frame, or
/// both senders back off. Under other access models the first frame has ended.
/// @param bytes  size of a message [bytes]
Duration collision_free_gap(const Scenario& scenario, std::uint32_t bytes);

/// Adds one notice if flows of several robots start messages at the same instant and their frames
/// collide. The notice names the first two robots.
void note_equal_starts(Scenario& scenario);

}  // namespace rovernet
