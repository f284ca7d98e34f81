// SPDX-License-Identifier: MIT
#include "sim/time.hpp"

#include <cmath>
#include <stdexcept>

namespace rovernet {

Duration from_seconds(double s) {
    constexpr double limit_s = 9.2e9;
    if (!(std::abs(s) <= limit_s)) {
        throw std::invalid_argument("a time must be within +-9.2e9 s (292 years), got " +
                                    std::to_string(s) + " s");
    }
    return Duration{std::llround(s * 1e9)};
}

}  // namespace rovernet
