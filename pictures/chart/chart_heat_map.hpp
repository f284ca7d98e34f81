// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart_marks.hpp"

namespace rovernet {

/// Draws the cells of a heat map, with their values where the text fits. A cell without a value is
/// crossed out. @param colors  axis of the colour scale
void draw_cells(Svg& svg, const ChartView& view, const ChartFrame& frame, const ChartAxis& colors);

/// Draws the colour bar of a heat map, right of the chart's frame.
/// @param number  number of the chart in the SVG document, from 0
void draw_color_bar(Svg& svg, const ChartFrame& frame, const ChartAxis& colors, std::size_t number);

/// Threshold of the text colour in a heat map: cells with at least this value are light and have
/// dark text, cells with a lower value have white text.
double dark_text_from(const ChartAxis& colors);

/// Whether at least one cell of the heat map has no value.
bool has_missing_cells(const ChartView& view);

/// Appends the diagonals of `box` to `path`, as the mark of a heat map's cell without a value.
void append_cross(SvgPath& path, const Box& box);

constexpr const char* missing_color = "#999999";
/// Width of the colour bar of a heat map [px], with its numbers and the gap before it.
constexpr double color_bar_width = 84;

}  // namespace rovernet
