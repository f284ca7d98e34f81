// SPDX-License-Identifier: MIT
#pragma once

#include "study/cells.hpp"
#include "study/statistics/interval.hpp"
#include "study/statistics/quantile.hpp"
#include "study/store.hpp"
#include "study/statistics/summary.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A key that varies, and the value that it has to have, as results print it.
struct Condition {
    std::string path, value;
};

/// Question to a study.
struct Question {
    std::vector<std::string> metrics =
        {};  ///< metrics; those of [study] metrics if empty, or the usual
    /// Paths that vary; all of them if not given, none: everything in one row.
    std::optional<std::vector<std::string>> group_by = {};
    std::vector<Condition> where = {};      ///< conditions that all points meet
    std::optional<double> confidence = {};  ///< confidence; as in [study] if not given
    std::optional<double> quantile = {};    ///< quantile to answer with, in place of the mean
    /// Method of intervals of means; as in [study] if not given, else see method_for().
    std::optional<IntervalMethod> interval = {};
    bool common = false;  ///< average only over the cells that every row has
};

/// Answer: one metric of the points that agree in what a question groups by.
struct Answer {
    Table settings;      ///< path -> value, of the keys that it groups by
    std::string metric;  ///< name of the metric
    std::map<std::uint32_t, double>
        values;                       ///< values by replication: the mean over the row's points
    Gaps gaps;                        ///< the row's runs that are not in the values
    std::uint64_t cells = 0;          ///< cells of each row of this metric: see Cells
    std::uint64_t left_out = 0;       ///< cells left out by Question::common
    std::optional<Summary> summary;   ///< summary of the values; nothing without any
    std::optional<double> value;      ///< the mean or the quantile
    std::optional<double> low, high;  ///< interval, if there are enough values for one
    std::optional<IntervalMethod> method;  ///< method of the interval of a mean
    bool skewed = false;                   ///< see MeanInterval
};

/// Answers of a study.
struct Answers {
    std::vector<Answer> list;           ///< row by row, and in each metric by metric
    std::vector<std::string> averaged;  ///< keys that a row has several values of
    std::vector<std::string> along;     ///< keys that go with a row, such as those of a zip
    RunCounts runs;                     ///< runs of the whole study, whatever the question
};

/// Answers a question about a study.
///
/// The replication is the unit: points that a row joins are averaged in each replication first,
/// with equal weights. All rows that join points must have the same cells (a cell is a combination
/// of the keys averaged over, in one replication): a row without some cell, as a run failed, is
/// missing or has no value, would differ from the others by that alone.
/// @throws std::invalid_argument for a metric or path that the study does not have, if no point
///         meets the conditions, or if rows that join points are of different cells and the
///         question does not say `common`
Answers answers(const Store& store, const Question& question);

/// Coverage of the numbers in words, what was averaged over and what is not in them: "averaged over
/// routing.ttl". Empty if each row is one point and nothing failed, is undefined or missing.
std::string coverage_text(const Answers& answers);

/// The paths that vary in the store's study.
std::vector<std::string> varied_paths(const Store& store);

/// [study] confidence of the study.
double confidence_of(const Store& store);

/// Method of intervals that the study asks for, if any: StudyTable::interval_wish().
std::optional<IntervalMethod> interval_method_of(const Store& store);

/// The points that meet all conditions. @throws std::invalid_argument if none does
std::vector<StoredPoint> points_where(const Store& store, const std::vector<Condition>& where);

/// The metrics that a question asks for. @throws std::invalid_argument for an unknown one
std::vector<std::string> metrics_of(const Store& store, const Question& question);

}  // namespace rovernet
