// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation.hpp"

#include <string>

// Reports of a validation: pictures, tables and pages.

namespace rovernet {

/// Picture of a chart as SVG. It has a dot plot for each panel, with a row for each method in order
/// of cost. Each row shows the error with its interval and, on a second scale, the cost. Names of
/// methods on the Pareto front are bold. Empty if all errors are 0.
std::string validation_svg(const ValidationChart& chart);

/// Numbers of a chart as comma-separated values. Columns: panel, method, series, cost_ns,
/// cost_low_ns, cost_high_ns, error, error_low, error_high, then further columns with their units.
/// Costs are measured on this machine.
std::string validation_csv(const ValidationChart& chart);

/// Self-contained HTML page of a validation, with sentences, pictures and tables.
std::string validation_html(const Validation& validation);

/// Text of the documentation page docs/methods/accuracy.md: sentences, with links to the pictures
/// and to the numbers, of all charts that are not for contributors.
std::string accuracy_page(const Validation& validation);

/// Text of the documentation page docs/inside/promises.md: the checked error limits, and the charts
/// for contributors.
std::string promises_page(const Validation& validation);

}  // namespace rovernet
