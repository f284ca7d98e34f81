// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>

namespace rovernet {

/// Area of a chart between its axes.
struct ChartFrame {
    Box box;  ///< position and size of the area [px]
    ChartAxis x, y;
    double inset = 0;  ///< [px] margin left and right of the marks, so that none touches the y axis
    double rise = 0;   ///< [px] margin below and above the marks, so that none leaves the box

    PicturePoint at(double x_value, double y_value) const;
};

// Functions that draw the points of a chart, one function for each kind of chart.

/// Draws the lines of a line chart, with marks. Intervals are drawn as a band, or as whiskers if
/// points are few or x is categorical. Series with overlapping whiskers are drawn a few pixels
/// apart.
void draw_lines(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame);
/// Draws the bars of a bar chart, or dots if ChartView::dots is set, with whiskers.
void draw_bars(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame);
/// Draws the marks of a scatter chart with whiskers and labels. Marks at the same point are drawn
/// side by side.
/// @return number of labels that found no free place
std::size_t draw_scatter(Svg& svg, const Chart& chart, const ChartView& view,
                         const ChartFrame& frame);
/// Draws the steps of a cumulative distribution function.
void draw_cdf(Svg& svg, const ChartView& view, const ChartFrame& frame);

/// Margin [px] that marks need left and right of their points: half a mark, and the offset between
/// the marks of several series.
double reach_of_marks(const Chart& chart, const ChartView& view, const ChartFrame& frame);
/// Margin [px] that marks need below and above their points; 0 in charts without marks.
double rise_of_marks(const Chart& chart, const ChartView& view);
/// Whether a line chart has room for a mark at each point.
bool room_for_marks(const ChartView& view, const ChartFrame& frame);
/// Fill colour of the bars of the series with index `series`.
Color bar_color(std::size_t series);
/// Draws a mark of a series. @param tip  tooltip of the mark, or ""
void draw_mark(Svg& svg, PicturePoint at, const ChartStyle& style, const std::string& tip);

}  // namespace rovernet
