// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/legend.hpp"

namespace rovernet {

/// Legend of a chart: names of the series, up to a limit, and the symbol of a heat map's cell
/// without a value.
/// @param marks  whether lines of the chart have marks  @param width  width of the legend [px]
Legend chart_legend(const Chart& chart, const ChartView& view, bool marks, double width);

}  // namespace rovernet
