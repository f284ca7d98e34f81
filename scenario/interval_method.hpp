// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Method by which the interval of a mean is made. A study may name it; otherwise the metric
/// decides.
///
/// - `t`: Student's t, which supposes that means are normal.
/// - `betting`: supposes only that the values have bounds; wider, but right for ratios near 0 or 1.
///
/// [study] interval chooses one; interval_of() in study/interval.hpp makes both.
enum class IntervalMethod { t, betting };

template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 2> values = {"t", "betting"};
};

}  // namespace rovernet
