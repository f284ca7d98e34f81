// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation.hpp"

#include <string>

// Reports of a validation: pictures, tables and pages.

namespace rovernet {

/// Chart as a picture: cost along x and error along y, both mostly logarithmic; the whiskers of x
/// are the lowest and highest turn, and a dashed line joins the points that nothing beats.
std::string validation_svg(const ValidationChart& chart);

/// Numbers of a chart as comma-separated values: panel, method, series, cost_ns, cost_low_ns,
/// cost_high_ns, error, error_low, error_high, then further columns with their units. Costs are
/// those of this machine.
std::string validation_csv(const ValidationChart& chart);

/// Everything as one page that needs no other file and no network: sentences, pictures, tables.
std::string validation_html(const Validation& validation);

/// Page of the documentation, docs/accuracy.md: sentences and tables, with links to the pictures.
/// Costs have two digits.
std::string validation_page(const Validation& validation);

}  // namespace rovernet
