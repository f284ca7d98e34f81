// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Row of a fit chart: a model with its errors as given and fitted, and its cost.
struct FitRow {
    std::string name;
    std::optional<double> as_given = {}, fitted = {};  ///< errors [unit of the chart], >= 0
    double cost = 1;                                   ///< cost relative to the reference [-], > 0
    bool best = false;  ///< true: the row is highlighted, with its smaller error as a number

    /// Smaller of the two errors; infinite if the row has none.
    double least_error() const {
        constexpr double none = std::numeric_limits<double>::infinity();
        return std::min(as_given.value_or(none), fitted.value_or(none));
    }
};

/// Panel of a fit chart: the models on one scene, compared with one reference.
struct FitPanel {
    std::string title, reference;
    std::vector<FitRow> rows = {};  ///< rows from the top
};

/// Fit chart: panels below one another with one scale of errors. In each row, a hollow dot is the
/// error of a model as given, a filled dot the error of the fitted model, and a fraction on the
/// right the cost of the model.
struct FitChart {
    std::string title, subtitle, value_label;
    std::vector<FitPanel> panels = {};
    std::vector<std::string> notes = {};  ///< lines below the panels
};

/// Text of a cost relative to the reference, with one significant digit: "1/4,000", "2 times", or
/// "the same" from 0.95 to 1.5.
std::string cost_text(double cost);

/// Draws a fit chart as an SVG document, 900 px wide. The bytes are the same on every machine.
std::string fit_chart_svg(const FitChart& chart);

}  // namespace rovernet
