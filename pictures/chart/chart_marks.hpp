// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>

namespace rovernet {

/// The part of a chart between its axes.
struct ChartFrame {
    Box box;  ///< [px]
    ChartAxis x, y;
    double inset = 0;  ///< [px] left and right, so that no mark stands on the y axis

    PicturePoint at(double x_value, double y_value) const;
};

// Functions that draw the points of a chart into its frame, one for each kind.

/// Lines with marks, and the intervals as a band, or as whiskers where there are few points or x is
/// a word. Series whose whiskers hide one another stand a few pixels apart.
void draw_lines(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame);
/// Bars or dots, with whiskers.
void draw_bars(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame);
/// Marks with whiskers and labels; what would hide another point stands a few pixels beside it.
/// @return how many labels found no place
std::size_t draw_scatter(Svg& svg, const Chart& chart, const ChartView& view,
                         const ChartFrame& frame);
/// Steps of a distribution function.
void draw_cdf(Svg& svg, const ChartView& view, const ChartFrame& frame);

/// Whether a chart of lines has room for the marks of its points.
bool room_for_marks(const ChartView& view, const ChartFrame& frame);
/// The inside of a series' bars.
Color bar_color(std::size_t series);
/// Draws a mark of a series. @param tip  what a viewer shows for it, or ""
void draw_mark(Svg& svg, PicturePoint at, std::size_t series, const std::string& tip);

}  // namespace rovernet
