// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string_view>

namespace rovernet {

/// Range of a number, and its text in an error ("must be > 0"). The limits are in the unit that
/// number_in() returns for the parameter.
struct Range {
    /// Lower limit of the number.
    double low = -std::numeric_limits<double>::infinity();
    /// Upper limit of the number, included.
    double high = std::numeric_limits<double>::infinity();
    /// Whether the lower limit is included.
    bool low_included = true;
    /// Text that follows "must be" in an error.
    std::string_view text = "finite";

    /// Whether `v` is finite and lies in the range; false for NaN.
    constexpr bool contains(double v) const {
        constexpr double largest = std::numeric_limits<double>::max();
        return v >= -largest && v <= largest && (low_included ? v >= low : v > low) && v <= high;
    }
};

/// Common ranges: any finite number; finite and > 0; finite and >= 0.
inline constexpr Range any{};
inline constexpr Range positive{.low = 0, .low_included = false, .text = "> 0"};
inline constexpr Range non_negative{.low = 0, .text = ">= 0"};

}  // namespace rovernet
