// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Way in which a fit to measured losses determines a parameter of a propagation model.
struct Fit {
    enum class Way {
        none,       ///< the parameter keeps its value
        linear,     ///< the loss is linear in it
        constant,   ///< a term of the loss that is equal for all links, and linear
        searched,   ///< the loss is linear only near the best value, which is searched for
        decisions,  ///< links within it are up: the value with the fewest wrong decisions
        spread      ///< the standard deviation of the losses about those of the model
    };
    Way way = Way::none;
    /// Value, in the unit of number_in(), near which the loss is linear; no loss is clipped at 0
    /// there.
    double base = 0;
};

/// Base of a constant term [dB] at which no loss is clipped at 0.
inline constexpr double far_from_zero = 500;

}  // namespace rovernet
