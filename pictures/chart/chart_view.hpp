// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rovernet {

/// Point of a chart, ready to be drawn.
struct DrawnPoint {
    double x = 0;  // x coordinate: a number, or the index of a category
    double y = 0;
    std::optional<double> low = {}, high = {};
    bool joined = false;                 // whether a line joins this point to the previous one
    const ChartPoint* source = nullptr;  // corresponding point of the chart
};

/// Drawable content of a chart. The view refers to the chart, which must outlive the view.
struct ChartView {
    bool has_words = false;          ///< true: the x axis has categories; false: numbers
    std::vector<std::string> words;  ///< categories along the x axis, at x = 0, 1, 2 ...
    /// Points of each series of the chart, sorted by x (except in a scatter chart). In a cumulative
    /// distribution, the points are the steps, and y is the share.
    std::vector<std::vector<DrawnPoint>> series;
    std::size_t points = 0;  ///< number of points in all series
    std::size_t left_out = 0;
    bool dots = false;        ///< true: dots are drawn instead of bars
    ChartRange x_range = {};  ///< range of the points' numeric x
    ChartRange y_range = {};  ///< range of y, including intervals, and 0 if bars begin there
    ChartLimits y_limits = {};

    /// Notes below the chart: Chart::note, and further notes, such as omitted values.
    std::vector<std::string> notes;
};

/// Drawable content of a chart. @param chart  must outlive the result
ChartView view_of(const Chart& chart);

/// Whether the intervals of a line are drawn as a band. This is so only if x is numeric and the
/// line has many points, since a band suggests values between points.
bool has_band(const ChartView& view, std::size_t series);

/// Whether the categories of a chart are too long for labels side by side in a picture of usual
/// width.
bool long_words(const ChartView& view);

/// Offset of a bar's middle from the middle of its category, as a share of the distance between
/// categories. @param series  index of the bar's series  @param count  number of series
double bar_offset(std::size_t series, std::size_t count);
/// Width of all bars of one category, as a share of the distance between categories.
constexpr double bars_at_word = 0.8;

}  // namespace rovernet
