// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_marks.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>

// What a scatter has besides its marks: a band, lines behind the marks, and intervals along x.

namespace rovernet {

/// Draws the band at the lower edge with its words, which take their place among the labels.
void draw_band(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels);
/// Draws the lines behind the marks; labels avoid them from now on.
void draw_guides(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels);
/// Level whiskers of a series: the intervals of its points along x. Labels avoid them.
SvgPath x_whiskers(const ChartView& view, std::size_t series, const ChartFrame& frame,
                   LabelPlaces& labels);

}  // namespace rovernet
