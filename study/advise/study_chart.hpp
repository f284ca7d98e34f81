// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "study/advise/compare.hpp"
#include "study/results.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Request for a chart of a study: kind of chart, and data to show.
struct ChartQuestion {
    /// Kind of the chart; none: lines or bars, depending on the values of x.
    std::optional<ChartKind> kind = {};
    std::string x = {};   ///< varied key along the x axis, see varied_path(); empty for a cdf
    std::string y = {};   ///< metric along the y axis
    std::string by = {};  ///< varied key; each of its values has a series, or a row of a heat map
    std::vector<Condition> where = {};  ///< conditions that all shown points of the study meet
    std::optional<double> confidence = {};
    std::optional<double> quantile = {};
    std::optional<IntervalMethod> interval = {};  ///< method of confidence intervals; none: see
                                                  ///< Question::interval
    bool log_x = false, log_y = false;
    /// True: average only over cells (combinations of averaged values and replication) in which
    /// every x and series of the chart has a value, see Cells.
    bool common = false;
    /// Path of a CSV file whose rows are drawn as marks beside lines, see add_marks(); empty: none.
    std::string beside = {};
};

/// Label of an axis: "NAME [UNIT]", or NAME without a unit.
std::string axis_label(const std::string& name, const std::string& unit);
/// Series of a chart with a name; it is added if there is none.
ChartSeries& series_named(Chart& chart, const std::string& name);

/// Full path of the varied key that the user calls `word`. The word may be the full path, the last
/// part of the path if only one varied key ends with that part, or "robots" for the count of
/// robots.
/// @param paths  paths of all varied keys
/// @throws std::invalid_argument if no key or several keys match
std::string varied_path(const std::vector<std::string>& paths, const std::string& word);

/// Condition of a text such as "ttl=6". @throws std::invalid_argument if it is not KEY=VALUE
Condition condition_of(const std::string& text);
/// Conditions of several texts; varied_path() finds the keys.
/// @throws std::invalid_argument as condition_of() and varied_path()
std::vector<Condition> conditions_of(const std::vector<std::string>& paths,
                                     const std::vector<std::string>& texts);

/// Chart of a study. It shows a value with its interval for each x and series or, if the kind is
/// cdf, the distribution over replications. Results are averaged over varied keys other than `x`
/// and `by`, as in answers(). The chart's note lists the averaged keys, the number of replications,
/// and missing runs.
/// @throws std::invalid_argument as answers(); InputError as add_marks()
Chart study_chart(const Store& store, const ChartQuestion& question);

/// Two charts of a comparison. The first shows the metric of each model with its interval, the
/// second each model's error (against the most detailed model) over its cost.
std::vector<Chart> comparison_charts(const Comparison& comparison);

/// Chart of routing protocols: delivery ratio of each protocol over its airtime for each delivered
/// byte, with the intervals of both quantities. Upper left is better than lower right.
/// @param store    store of a study that varies only routing.protocol
/// @param remarks  texts for the note of the chart, such as Comparison::held; empty ones are left
///                 out
Chart protocol_chart(const Store& store, std::vector<std::string> remarks);

}  // namespace rovernet
