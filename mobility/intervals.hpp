// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

namespace rovernet {

/// Times between the steps of a movement, and rests [s]: the clock has room for many of them.
inline constexpr Range step_length{
    .low = 1e-6, .high = 9e8, .text = "from 1 us to 9e8 s (28 years)"};
inline constexpr Range rest_length{.low = 0, .high = 9e8, .text = "from 0 s to 9e8 s (28 years)"};

}  // namespace rovernet
