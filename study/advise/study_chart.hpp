// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/compare.hpp"
#include "study/results.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Question of a chart: what of a study it shows.
struct ChartQuestion {
    std::optional<ChartKind> kind = {};  ///< kind; by the values of x if not given: lines or bars
    std::string x = {};                  ///< key that varies, see varied_path(); of a cdf none
    std::string y = {};                  ///< metric
    std::string by = {};                 ///< key of the series, or of the rows of a heat map
    std::vector<Condition> where = {};   ///< conditions that all points meet
    std::optional<double> confidence = {};
    std::optional<double> quantile = {};
    std::optional<IntervalMethod> interval = {};  ///< method, as in Question
    bool log_x = false, log_y = false;
    bool common = false;  ///< only of the cells that every place of the chart has
};

/// The key that a word means: the whole path, or its last part if no other path ends so, or
/// "robots" for the count of robots. @throws std::invalid_argument if it means none
std::string varied_path(const std::vector<std::string>& paths, const std::string& word);

/// Texts such as "ttl=6" as conditions on the keys that their first parts mean.
/// @throws std::invalid_argument
std::vector<Condition> conditions_of(const std::vector<std::string>& paths,
                                     const std::vector<std::string>& texts);

/// Chart of a study: a value with its interval per x and series, or, as cdf, the distribution over
/// the replications. Keys that are neither x nor by are averaged over, as answers() does; its note
/// names them, n, and the runs that are not in it.
/// @throws std::invalid_argument as answers()
Chart study_chart(const Store& store, const ChartQuestion& question);

/// A comparison as two charts: the metric of each model with its interval, and its error to the
/// most detailed model against its cost.
std::vector<Chart> comparison_charts(const Comparison& comparison);

}  // namespace rovernet
