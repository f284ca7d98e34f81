// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart_marks.hpp"

namespace rovernet {

/// Draws the cells of a heat map with their values, where these fit; what has no value is crossed
/// out. @param colors  where the colours end
void draw_cells(Svg& svg, const ChartView& view, const ChartFrame& frame, const ChartAxis& colors);

/// Draws the bar that tells the colours, right of the frame.
/// @param number  of the chart in its document
void draw_color_bar(Svg& svg, const ChartFrame& frame, const ChartAxis& colors, std::size_t number);

/// The value from which the colours are so light that text on them is dark; white below.
double dark_text_from(const ChartAxis& colors);

/// Whether a cell of the heat map has no value.
bool has_missing_cells(const ChartView& view);

/// The sign of a cell without a value: from corner to corner.
void append_cross(SvgPath& path, const Box& box);

constexpr const char* missing_color = "#999999";
constexpr double color_bar_width = 84;  ///< [px] with its numbers and the gap before it

}  // namespace rovernet
