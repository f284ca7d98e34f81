// SPDX-License-Identifier: MIT
// Must not compile: the sum of two levels is the product of two powers. With -DCONTROL it must,
// which shows that nothing else is wrong with the file.
#include "sim/units.hpp"

using namespace rovernet;

int main() {
#ifdef CONTROL
    const auto level = 10_dBm + 3_dB;
#else
    const auto level = 10_dBm + 3_dBm;
#endif
    return level.value > 0 ? 0 : 1;
}
