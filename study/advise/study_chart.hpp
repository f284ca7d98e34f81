// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/compare.hpp"
#include "study/results.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Request for a chart of a study: the data to show.
struct ChartQuestion {
    /// Kind of the chart; none: lines or bars, depending on the values of x.
    std::optional<ChartKind> kind = {};
    std::string x = {};   ///< varied key along the x axis, see varied_path(); empty for a cdf
    std::string y = {};   ///< metric along the y axis
    std::string by = {};  ///< varied key with a series, or row of a heat map, for each value
    std::vector<Condition> where = {};  ///< conditions that all shown points of the study meet
    std::optional<double> confidence = {};
    std::optional<double> quantile = {};
    std::optional<IntervalMethod> interval = {};  ///< interval method; none: see Question::interval
    bool log_x = false, log_y = false;
    /// True: average only over cells for which every position of the chart has a value, see Cells.
    bool common = false;
    /// Path of a CSV file whose rows are drawn as marks beside lines, see add_marks(); empty: none.
    std::string beside = {};
};

/// Full path of the varied key that the user names by `word`. The word may be the full path, the
/// last part of the path if only one varied key ends with that part, or "robots" for the count of
/// robots.
/// @param paths  paths of all varied keys
/// @throws std::invalid_argument if no key or several keys fit
std::string varied_path(const std::vector<std::string>& paths, const std::string& word);

/// Parses texts such as "ttl=6" into conditions; the key is found by varied_path().
/// @throws std::invalid_argument if a text is not KEY=VALUE, or as varied_path()
std::vector<Condition> conditions_of(const std::vector<std::string>& paths,
                                     const std::vector<std::string>& texts);

/// Chart of a study: a value with its interval for each x and series or, as cdf, the distribution
/// over replications. Results are averaged over varied keys other than `x` and `by`, as in
/// answers(). The chart's note lists the averaged keys, the number of replications, and missing
/// runs.
/// @throws std::invalid_argument as answers(); InputError as add_marks()
Chart study_chart(const Store& store, const ChartQuestion& question);

/// Two charts of a comparison: the metric of each model with its interval, and each model's error
/// (against the most detailed model) over its cost.
std::vector<Chart> comparison_charts(const Comparison& comparison);

/// Chart of routing protocols: the delivery ratio of each over the airtime for each byte delivered,
/// with the intervals of both. Lower right is worse than upper left.
/// @param store  store of a study that varies only routing.protocol
/// @param held   other keys that vary, with the values at which they are fixed, for the note
Chart protocol_chart(const Store& store, const std::string& held);

}  // namespace rovernet
