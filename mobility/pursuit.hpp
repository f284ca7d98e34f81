// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Position of `leader` at `t` >= mover.now [m], as far as its present leg says, at the mover's own
/// height.
/// @throws std::invalid_argument if there is no such robot
Vec3 foreseen(const Mover& mover, NodeId leader, Time t, std::string_view model);

/// The part of a leg, which begins where the mover is, until `end` > mover.now; all of it if it
/// ends before.
Leg cut_short(const Mover& mover, const Leg& leg, Time end);

/// A nanosecond's rest: at the start of a run, until everybody has been placed.
Leg moment(const Mover& mover);

}  // namespace rovernet
