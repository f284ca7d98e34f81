// SPDX-License-Identifier: MIT
#include "sim/told_apart.hpp"

#include <fmt/format.h>

namespace rovernet {

std::string told_apart(double v, double limit, int decimals) {
    constexpr int most = 12;
    for (int n = decimals; n <= most; ++n) {
        std::string text = fmt::format("{:.{}f}", v, n);
        const double shown = std::stod(text);
        if (v < limit ? shown < limit : shown > limit) return text;
    }
    return fmt::format("{}", v);
}

}  // namespace rovernet
