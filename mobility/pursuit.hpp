// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Position of the robot `leader` at `t` >= mover.now [m], predicted by the leader's current leg;
/// the height is the mover's.
/// @throws std::invalid_argument if there is no such robot; the error names the movement `model`
Vec3 foreseen(const Mover& mover, NodeId leader, Time t, std::string_view model);

/// Shortens `leg`, the mover's next leg (piece of movement from its position), so that it ends at
/// `end` > mover.now. A leg that ends before `end` is returned unchanged.
Leg cut_short(const Mover& mover, const Leg& leg, Time end);

/// Leg at rest at the mover's position for one nanosecond: a wait at the start of a run until all
/// robots have been placed.
Leg moment(const Mover& mover);

}  // namespace rovernet
