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

/// Way in which a fit to measured losses determines a parameter of a propagation model.
struct Fit {
    enum class Way {
        none,       ///< the parameter keeps its value
        linear,     ///< the loss is linear in the parameter
        constant,   ///< the parameter is a linear term of the loss, equal for all links
        searched,   ///< the loss is linear only near the best value, which is searched for
        decisions,  ///< range of links: the value with the fewest wrong up/down decisions
        spread      ///< standard deviation of the measured losses about the losses of the model
    };
    Way way = Way::none;
    /// Value of the parameter, in the unit of number_in(), near which the loss is linear in the
    /// parameter: at this value no loss is clipped at 0.
    double base = 0;
};

/// Value of Fit::base [dB] for a constant term of the loss: with it no loss is clipped at 0.
inline constexpr double far_from_zero = 500;

}  // namespace rovernet
