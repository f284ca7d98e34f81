// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/advise.hpp"

#include <vector>

namespace rovernet {

/// Charts of an advice with errors on one axis and costs on the other. The first chart shows path
/// losses over the CPU time to find receivers per transmission. The second shows all compared
/// candidates over the CPU time of a run. Marks are |bias| and run error with their intervals. If
/// costs were not measured, the result is one bar chart of errors.
std::vector<Chart> advice_charts(const Advice& advice);

}  // namespace rovernet
