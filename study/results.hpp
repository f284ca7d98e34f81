// SPDX-License-Identifier: MIT
#pragma once

#include "study/interval.hpp"
#include "study/quantile.hpp"
#include "study/store.hpp"
#include "study/summary.hpp"

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

/// What a study is asked for.
struct Question {
    std::vector<std::string> metrics = {};  ///< those of [study] metrics if empty, or the usual
    /// Paths that vary; all of them if not given, none: everything in one group.
    std::optional<std::vector<std::string>> group_by = {};
    std::vector<Condition> where = {};      ///< of the points that meet all of these
    std::optional<double> confidence = {};  ///< as in [study] if not given
    std::optional<double> quantile = {};    ///< this one, in place of the mean
    /// How intervals of means are made: as in [study] if not given, else see method_for().
    std::optional<IntervalMethod> interval = {};
};

/// One metric of the points that agree in what a question groups by.
struct Answer {
    Table settings;                          ///< path -> value, of the keys that it groups by
    std::string metric;                      ///< its name
    std::map<std::uint32_t, double> values;  ///< by replication: the mean over the group's points
    std::size_t undefined = 0;               ///< finished runs in which the metric has no value
    std::optional<Summary> summary;          ///< of the values; nothing without any
    std::optional<double> value;             ///< the mean or the quantile
    std::optional<double> low, high;         ///< its interval, if there are enough values for one
    std::optional<IntervalMethod> method;    ///< of the interval of a mean
    bool skewed = false;                     ///< see MeanInterval
};

/// Answers group by group, in the order of their points, and in it metric by metric. The
/// replication is the unit: points that a group joins are averaged in each replication first.
/// @throws std::invalid_argument for a metric or path that the study does not have, or if no point
///         meets the conditions
std::vector<Answer> answers(const Store& store, const Question& question);

/// The paths that vary in the store's study.
std::vector<std::string> varied_paths(const Store& store);

/// [study] confidence of the study.
double confidence_of(const Store& store);

/// [study] interval of the study, if given.
std::optional<IntervalMethod> interval_method_of(const Store& store);

/// What every result is, as comma-separated values (RFC 4180) with a head: a row per finished run
/// and metric, sorted by point, replication and metric: point, the varied keys, replication,
/// metric, value (empty if undefined). The same bytes for the same results.
/// @param write  gets the text piece by piece
/// @param provenance  a row per run instead, failed ones too: its id, fingerprint, times, host
void write_csv(const Store& store, bool provenance,
               const std::function<void(std::string_view)>& write);

}  // namespace rovernet
