// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/legend.hpp"

namespace rovernet {

/// The series of a chart by name, as many as a reader can bear, and the sign of a cell without a
/// value. @param marks  whether lines carry marks  @param width  [px] of the legend
Legend chart_legend(const Chart& chart, const ChartView& view, bool marks, double width);

}  // namespace rovernet
