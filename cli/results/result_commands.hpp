// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/commands.hpp"

#include <optional>
#include <string>
#include <vector>

/// Commands that read the stored results of studies: results, plot, explain.
namespace rovernet::cli {

struct ResultsArguments {
    std::string store;
    std::vector<std::string> metrics, group_by, where;
    std::optional<double> confidence, quantile;
    std::optional<std::string> interval;
    std::optional<std::string> sql;
    bool csv = false, json = false, provenance = false, failures = false, common = false;
};
void results(const ResultsArguments& arguments);

struct PlotArguments {
    std::string store, x, by, kind, beside, out;
    std::vector<std::string> y, where;
    std::optional<std::string> x_title;
    std::vector<std::string> y_titles;  ///< one for each chart; empty: the names of the metrics
    std::optional<double> confidence, quantile, width;
    std::optional<std::string> interval;
    bool log_x = false, log_y = false, common = false;
    double font_size = 12;
};
void plot(const PlotArguments& arguments);

struct ExplainArguments {
    std::string store, run;
    bool json = false;
};
void explain(const ExplainArguments& arguments);

}  // namespace rovernet::cli
