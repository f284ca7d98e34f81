// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Range of numbers along a chart's axis: the least and the greatest number added so far.
class ChartRange {
  public:
    void include(double v);
    bool empty() const { return empty_; }
    double low() const { return low_; }    ///< least number of the range; 0 without numbers
    double high() const { return high_; }  ///< greatest number of the range; 0 without numbers
    bool whole() const { return whole_; }  ///< whether all numbers of the range are whole

  private:
    bool empty_ = true, whole_ = true;
    double low_ = 0, high_ = 0;
};

struct ChartTick {
    double value = 0;
    std::string text;  ///< label of the tick; empty: a minor tick
};

/// Axis of a chart: range of shown values, and ticks in ascending order.
struct ChartAxis {
    double low = 0, high = 1;  ///< ends of the axis, low < high; 0 < low if logarithmic
    bool log = false;
    std::vector<ChartTick> ticks = {};

    /// Position of a value on the axis, from 0 (low end) to 1 (high end); clamped beyond the ends.
    double share(double v) const;
    /// Text of a value on a linear axis, rounded to about 1 % of the axis's length.
    std::string text(double v) const;
};

/// Numeric axis that shows the whole range, with at most `most` >= 3 labels at multiples of 1, 2 or
/// 5 times a power of ten. A range of whole numbers has labels at whole numbers. A logarithmic axis
/// has labels at powers of ten, or at 1, 2 and 5 times powers of ten if these are at most `most`.
/// @param range   range of the numbers, within -1e100 ... 1e100; positive if log
/// @param limits  ends of the axis, unless the range exceeds them
ChartAxis number_axis(const ChartRange& range, bool log, int most, const ChartLimits& limits = {});

/// Axis of categories, at positions 0, 1, 2 ...
ChartAxis word_axis(const std::vector<std::string>& words);

/// Text of a number, with at most four digits (whole numbers below a million: all digits), such as
/// "0.25", "12 500" or "1.5e6".
std::string number_text(double v);

}  // namespace rovernet
