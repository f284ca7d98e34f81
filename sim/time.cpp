// SPDX-License-Identifier: MIT
#include "sim/time.hpp"

#include <cmath>
#include <stdexcept>

namespace rovernet {
namespace {

/// Nearest integer, from halves away from zero: std::llround(x), which is a call.
std::int64_t rounded(double x) {
    const auto whole = static_cast<std::int64_t>(x);
    const double rest = x - static_cast<double>(whole);  // exact
    return whole + (rest >= 0.5) - (rest <= -0.5);
}

}  // namespace

Duration from_seconds(double s) {
    constexpr double limit_s = 9.2e9;
    if (!(std::abs(s) <= limit_s)) {
        throw std::invalid_argument("a time must be within +-9.2e9 s (292 years), got " +
                                    std::to_string(s) + " s");
    }
    return Duration{rounded(s * 1e9)};
}

}  // namespace rovernet
