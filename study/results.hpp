// SPDX-License-Identifier: MIT
#pragma once

#include "study/cells.hpp"
#include "study/statistics/interval.hpp"
#include "study/statistics/quantile.hpp"
#include "study/statistics/summary.hpp"
#include "study/store.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Condition on a varied key of a study: the path of the key, and its required value as a text, as
/// printed in results.
struct Condition {
    std::string path, value;
};

/// Query of a study's results.
struct Question {
    /// Names of the metrics to compute, or quotients "A/B" of two metrics, run by run; empty: the
    /// metrics of [study] metrics, or else the default metrics.
    std::vector<std::string> metrics = {};
    /// Paths of varied keys. Points with equal values of these keys form a row of the table. Not
    /// given: all varied keys. Empty: one row for all points.
    std::optional<std::vector<std::string>> group_by = {};
    std::vector<Condition> where = {};  ///< conditions; only points that meet all conditions are
                                        ///< used
    std::optional<double> confidence = {};  ///< confidence level [-]; none: as in [study]
    std::optional<double> quantile = {};    ///< quantile to compute instead of the mean [-]
    /// Method of confidence intervals for means; none: as in [study], or else by method_for().
    std::optional<IntervalMethod> interval = {};
    bool common = false;  ///< true: average only over cells for which every row has a value
};

/// Value of one metric for one row of the results table (points with equal group_by values).
struct Answer {
    Table settings;                          ///< value of each group_by key, by the path of the key
    std::string metric;                      ///< name of the metric
    std::map<std::uint32_t, double> values;  ///< mean over the points of the row, by replication
    Gaps gaps;                               ///< number of runs of the row that have no value
    std::uint64_t cells = 0;                 ///< number of cells (averaged values x replications)
                                             ///< of each row
    std::uint64_t left_out = 0;              ///< number of cells skipped, since some row lacks a
                                             ///< value
    std::optional<Summary> summary;          ///< summary of the values; none without values
    std::optional<double> value;             ///< mean or quantile of `values`
    std::optional<double> low, high;  ///< ends of the confidence interval of `value`; none: too few
                                      ///< values
    std::optional<IntervalMethod> method;  ///< method of the interval of a mean
    bool skewed = false;  ///< true: `values` are too skewed for Student's t interval
};

/// Table of results of a study.
struct Answers {
    std::vector<Answer> list;           ///< answers, row by row, and within a row metric by metric
    std::vector<std::string> averaged;  ///< varied keys over which each row is averaged
    std::vector<std::string> along;     ///< varied keys outside of group_by with one value in each
                                        ///< row
    RunCounts runs;                     ///< counts of all runs of the study, for any query
};

/// Computes the results of a study for a query.
///
/// The replication is the unit of statistics: points of a row are first averaged in each
/// replication, with equal weights. All averaged rows must have the same cells (a cell is a
/// combination of values of the averaged keys, in one replication). A row lacks a cell if a run
/// failed, is missing or has no value; the lacking cell alone would make the row differ from other
/// rows.
/// @throws std::invalid_argument for an unknown metric or path, if no point meets the conditions,
///         or if rows have different cells and `common` is false
Answers answers(const Store& store, const Question& question);

/// Note on the runs from which results are computed: averaged keys and missing runs, such as
/// "averaged over routing.ttl". Empty if each row is one point and every run has a value.
std::string coverage_text(const Answers& answers);

/// Paths of the varied keys of the store's study.
std::vector<std::string> varied_paths(const Store& store);

/// Confidence level of intervals [-], from the study's table [study].
double confidence_of(const Store& store);

/// Method of confidence intervals that the study requests, see StudyTable::interval_wish(); none:
/// no request.
std::optional<IntervalMethod> interval_method_of(const Store& store);

/// Points of the study that meet all conditions. @throws std::invalid_argument if no point meets
/// all conditions
std::vector<StoredPoint> points_where(const Store& store, const std::vector<Condition>& where);

/// Names of the metrics that a query computes: Question::metrics, or else [study] metrics, or else
/// the default metrics. @throws std::invalid_argument for an unknown metric
std::vector<std::string> metrics_of(const Store& store, const Question& question);

}  // namespace rovernet
