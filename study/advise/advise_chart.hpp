// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/advise.hpp"

#include <vector>

namespace rovernet {

/// Charts of an advice, error against cost: path losses over the CPU time of the medium for each
/// transmission, and all compared candidates over the CPU time of a run. Marks are |bias| and run
/// error with their intervals. If costs were not measured, one bar chart.
std::vector<Chart> advice_charts(const Advice& advice);

}  // namespace rovernet
