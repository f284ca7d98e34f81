// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/collision.hpp"
#include "models/reception/sinr.hpp"

#include <variant>

namespace rovernet {

/// Reception rung "threshold": a frame is received wherever the link budget allows it.
struct Threshold {};

/// What becomes of frames at a receiver: the rungs, cheapest first.
using ReceptionRung = std::variant<Threshold, Collision, Sinr>;

}  // namespace rovernet
