// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Text of a decimal number, for a message that compares the number with a limit. The number is
/// rounded to `decimals` places, or to more if rounding would put the number on the other side of
/// the limit.
///
///   told_apart(0.0996, 0.1, 3) == "0.0996";  // not 0.100, which is not below 0.1
///
/// @param v  number, not equal to the limit
std::string told_apart(double v, double limit, int decimals);

}  // namespace rovernet
