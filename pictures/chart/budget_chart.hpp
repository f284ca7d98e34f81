// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace rovernet {

/// Step of a budget chart: gain (positive) or loss (negative) [dB].
struct BudgetStep {
    std::string name;
    double change;
};

/// Budget chart: the levels of a link from the sender's power to the received level, as a
/// staircase. Each step is a bar from the level before to the level after it. The last bar is the
/// margin between the received level and the sensitivity.
struct BudgetChart {
    std::string title, subtitle;
    double power = 0;  ///< level at the beginning [dBm]
    std::vector<BudgetStep> steps = {};
    double sensitivity = 0;  ///< least level that the receiver decodes [dBm]
};

/// Draws a budget chart as an SVG document, 760 px wide. The bytes are the same on every machine.
std::string budget_chart_svg(const BudgetChart& chart);

}  // namespace rovernet
