// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Position of `leader` at `t` >= mover.now [m], predicted by its current leg, at the mover's
/// height.
/// @throws std::invalid_argument if there is no such robot; the error names the movement `model`
Vec3 foreseen(const Mover& mover, NodeId leader, Time t, std::string_view model);

/// First part of a leg that starts at the mover's position, until `end` > mover.now; the whole leg
/// if it ends earlier.
Leg cut_short(const Mover& mover, const Leg& leg, Time end);

/// Leg at rest for one nanosecond, used at the start of a run until all robots have been placed.
Leg moment(const Mover& mover);

}  // namespace rovernet
