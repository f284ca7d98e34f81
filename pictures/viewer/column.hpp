// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace rovernet {

/// Time [ns] since the start of the run.
inline std::int64_t whole_ns(Time t) { return (t - start_of_run).count(); }
/// Time [ns] since the start of the run, as a floating-point number for a column; infinite for
/// `never`.
inline double column_ns(Time t) {
    return t == never ? std::numeric_limits<double>::infinity() : static_cast<double>(whole_ns(t));
}

/// Column of numbers: get(item) for each item of a range, in order.
template <class T, class Range, class Get>
std::vector<T> column(const Range& range, Get get) {
    std::vector<T> out;
    out.reserve(range.size());
    for (const auto& item : range) out.push_back(static_cast<T>(get(item)));
    return out;
}

}  // namespace rovernet
