// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <cstdint>

// Detection of messages of several robots that start at the same time, so that their frames
// collide.

namespace rovernet {

/// Least time between the starts of two frames [ns] with which the frames do not collide. Under
/// csma the second sender then senses the first frame, or both senders back off. Under other access
/// models the first frame has ended. The result is 0 if frames never collide.
/// @param bytes  size of a message [bytes]
Duration collision_free_gap(const Scenario& scenario, std::uint32_t bytes);

/// Adds one notice if flows of several robots start messages at the same instant and their frames
/// collide. The notice names the first two robots.
void note_equal_starts(Scenario& scenario);

}  // namespace rovernet
