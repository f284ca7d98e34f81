// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// number x 10^exponent, computed by moving the decimal point: 3730.3 and -2 give 37.303, the
/// double nearest to that decimal. A product or a quotient would round a second time.
///
/// The decimal is the shortest one that reads back as `number`: the typed one, if that has at most
/// 15 digits. Overflow gives an infinity, underflow 0; NaN and infinities are returned unchanged.
double times_power_of_ten(double number, int exponent);

}  // namespace rovernet
