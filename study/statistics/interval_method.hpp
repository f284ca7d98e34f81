// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Method for the confidence interval of a mean. A study may choose it; otherwise it depends on the
/// metric, and on whether the number of replications is fixed beforehand.
///
/// - `t`: Student's t, which assumes that means are normal.
/// - `betting`: betting confidence sequence; assumes only that values are bounded, and is valid at
///   any stopping time.
/// - `star`: STaR-Bets; also assumes only bounded values, and is narrower, but needs a number of
/// values fixed beforehand.
///
/// [study] interval chooses the method; interval_of() in study/statistics/interval.hpp computes the
/// interval.
enum class IntervalMethod { t, betting, star };

inline constexpr std::array all_interval_methods = {IntervalMethod::t, IntervalMethod::betting,
                                                    IntervalMethod::star};

template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 3> values = {"t", "betting", "star"};
};

}  // namespace rovernet
