// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// How the interval of a mean is made: by Student's t, which supposes that means are normal, or by
/// betting, which supposes only that the values have bounds.
enum class IntervalMethod { t, betting };

template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 2> values = {"t", "betting"};
};

}  // namespace rovernet
