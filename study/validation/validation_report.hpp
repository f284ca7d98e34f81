// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation.hpp"

#include <string>

// Reports of a validation: pictures, tables and pages.

namespace rovernet {

/// Picture of a chart: cost along x and error along y, both mostly logarithmic. Whiskers along x
/// show the lowest and highest measurement. A dashed line joins the points of the Pareto front.
std::string validation_svg(const ValidationChart& chart);

/// Numbers of a chart as comma-separated values. Columns: panel, method, series, cost_ns,
/// cost_low_ns, cost_high_ns, error, error_low, error_high, then further columns with their units.
/// Costs are measured on this machine.
std::string validation_csv(const ValidationChart& chart);

/// Self-contained HTML page with sentences, pictures and tables.
std::string validation_html(const Validation& validation);

/// Page of the documentation, docs/accuracy.md: sentences and tables, with links to the pictures.
/// Costs are rounded to two digits.
std::string validation_page(const Validation& validation);

}  // namespace rovernet
