// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_marks.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>

// Drawing of the parts of a scatter chart other than its marks: band, lines behind the marks,
// intervals along x.

namespace rovernet {

/// Draws the grey band at the lower edge of a chart, and the band's label at a free place.
void draw_band(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels);
/// Draws the lines behind the marks of a chart. Labels placed later avoid these lines.
void draw_guides(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels);
/// Horizontal whiskers of a series (the intervals of its points along x). Labels placed later avoid
/// the whiskers.
SvgPath x_whiskers(const ChartView& view, std::size_t series, const ChartFrame& frame,
                   LabelPlaces& labels);

}  // namespace rovernet
