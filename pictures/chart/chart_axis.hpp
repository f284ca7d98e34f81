// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The least and the greatest of some numbers.
class ChartRange {
  public:
    void include(double v);
    bool empty() const { return empty_; }
    double low() const { return low_; }    ///< 0 if empty
    double high() const { return high_; }  ///< 0 if empty
    bool whole() const { return whole_; }  ///< whether none of them has a fraction

  private:
    bool empty_ = true, whole_ = true;
    double low_ = 0, high_ = 0;
};

struct ChartTick {
    double value = 0;
    std::string text;  ///< empty: a small tick
};

/// An axis of a chart: what part of the numbers it shows, and its ticks in ascending order.
struct ChartAxis {
    double low = 0, high = 1;  ///< low < high; 0 < low if logarithmic
    bool log = false;
    std::vector<ChartTick> ticks = {};

    /// Place of a value, from 0 (low) to 1 (high); held beyond the ends.
    double share(double v) const;
    /// A value of an axis that is not logarithmic, to about a hundredth of it.
    std::string text(double v) const;
};

/// An axis of numbers. It shows the whole range, with at most `most` >= 3 texts at multiples of 1,
/// 2 or 5 times a power of ten; a range of whole numbers has texts at whole numbers. A logarithmic
/// axis has texts at powers of ten, or at 1, 2 and 5 times them if there are few.
/// @param range   within -1e100 ... 1e100, of positive numbers if log
/// @param limits  the axis ends there, unless the range itself goes beyond
ChartAxis number_axis(const ChartRange& range, bool log, int most, const ChartLimits& limits = {});

/// An axis of words, at 0, 1, 2 ...
ChartAxis word_axis(const std::vector<std::string>& words);

/// A number in four digits at most (whole numbers below a million in all), as in "0.25", "12 500"
/// or "1.5e6".
std::string number_text(double v);

}  // namespace rovernet
