// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/advise.hpp"

#include <vector>

namespace rovernet {

/// An advice as charts of error against cost: the path losses over the CPU time of the medium for
/// each transmission, and all that was judged over the CPU time of a run. Marks are |bias| and run
/// error with their intervals. Without costs one chart, of bars.
std::vector<Chart> advice_charts(const Advice& advice);

}  // namespace rovernet
