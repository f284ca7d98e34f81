// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Method by which the interval of a mean is made. A study may name it; otherwise the metric
/// decides, and whether the number of replications was fixed beforehand.
///
/// - `t`: Student's t, which supposes that means are normal.
/// - `betting`: supposes only that the values have bounds, and holds however often one looks.
/// - `star`: STaR-Bets, supposes as little and is narrower, for a number of values fixed
/// beforehand.
///
/// [study] interval chooses one; interval_of() in study/interval.hpp makes all of them.
enum class IntervalMethod { t, betting, star };

inline constexpr std::array all_interval_methods = {IntervalMethod::t, IntervalMethod::betting,
                                                    IntervalMethod::star};

template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 3> values = {"t", "betting", "star"};
};

}  // namespace rovernet
