// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rovernet {

/// A point as it is drawn.
struct DrawnPoint {
    double x = 0;  // a number, or the index of a word
    double y = 0;
    std::optional<double> low = {}, high = {};
    bool joined = false;                 // joined to the point before it
    const ChartPoint* source = nullptr;  // point of the chart
};

/// View of a chart: what can be drawn of it. It refers to the chart.
struct ChartView {
    bool has_words = false;          ///< x is a word
    std::vector<std::string> words;  ///< words at x = 0, 1, 2 ...
    /// Series in the chart's order, points in the order of x but for a scatter; the points of a cdf
    /// are its steps, y the share.
    std::vector<std::vector<DrawnPoint>> series;
    std::size_t points = 0;  ///< points in all series
    std::size_t left_out = 0;
    bool dots = false;        ///< dots are drawn instead of bars
    ChartRange x_range = {};  ///< range of numbers
    ChartRange y_range = {};  ///< range with the intervals, and 0 where bars begin there
    ChartLimits y_limits = {};

    /// The chart's note and what else a reader has to know.
    std::vector<std::string> notes;
};

/// @param chart  lives longer
ChartView view_of(const Chart& chart);

/// Whether the intervals of a line are drawn as a band: where x is a number and there are enough
/// points, as a band suggests values between them.
bool has_band(const ChartView& view, std::size_t series);

/// Whether the words of a chart are too long to stand side by side in an ordinary picture.
bool long_words(const ChartView& view);

/// Offset of the middle of a bar from its word, in parts of the distance between words.
double bar_offset(std::size_t series, std::size_t count);
/// The room for all bars at a word, in the same parts.
constexpr double bars_at_word = 0.8;

}  // namespace rovernet
