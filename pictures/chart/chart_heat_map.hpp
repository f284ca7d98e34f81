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

/// Least value whose cell in a heat map has dark text, since the cell is light; below: white text.
double dark_text_from(const ChartAxis& colors);

/// Whether a cell of the heat map has no value.
bool has_missing_cells(const ChartView& view);

/// Appends the cross of a heat map's cell without a value, from corner to corner.
void append_cross(SvgPath& path, const Box& box);

constexpr const char* missing_color = "#999999";
/// Width of the colour bar of a heat map [px], with its numbers and the gap before it.
constexpr double color_bar_width = 84;

}  // namespace rovernet
