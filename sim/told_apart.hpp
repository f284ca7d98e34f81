// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Decimal number for a message that compares it with a limit: rounded to `decimals` places, or to
/// more if the rounded number would not lie on the same side of the limit as `v`.
///
///   told_apart(0.0996, 0.1, 3) == "0.0996";  // not 0.100, which is not below 0.1
///
/// @param v  number, not equal to the limit
std::string told_apart(double v, double limit, int decimals);

}  // namespace rovernet
