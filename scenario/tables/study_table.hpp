// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/fields.hpp"
#include "study/statistics/interval.hpp"

#include <optional>
#include <string>
#include <vector>

// [study]: the points of a study (combinations of varied values), their replications and their
// metrics. `rovernet sweep` runs the study. A single run uses `warmup` and `metrics` only.
//
//     [study]
//     replications = 10
//     vary."routing.ttl" = [1, 2, 3]
//     vary."radio.power" = { from = "10 dBm", to = "20 dBm", step = "5 dBm" }

namespace rovernet {

/// Key of the scenario that a study varies, with the values that the key takes.
struct Vary {
    /// Path of the key, as for --set: "radio.power", "robot.NAME.radio.power".
    std::string path;
    /// File position of the path, for error messages.
    Location where;
    /// Values of the key, at least one; a range { from, to, step } is expanded.
    Array values;
};

/// Combinations of varied values that a study skips: the combinations in which every listed key has
/// one of its listed values. In the scenario file:
///
///   exclude = [{ "propagation.model" = "disc", "reception.model" = "sinr" }]
using Exclusion = std::vector<Vary>;

/// Warm-up of a run: initial part of the run, which is not measured.
struct Warmup {
    /// Duration of the warm-up [ns], from the start of the run. Messages sent during the warm-up
    /// are not counted.
    Duration given{0};
    /// True if the rule MSER-5, which detects the initial transient of a time series, computes the
    /// warm-up of each run; then `given` is not used.
    bool mser5 = false;
};

/// [study]: varied keys, replications, intervals and metrics of a study.
struct StudyTable {
    /// Least number of independent runs (replications) of each combination of varied values.
    int replications = 1;
    /// Probability that a confidence interval covers the true mean [-].
    double confidence = 0.95;
    /// Method of confidence intervals; none: the method depends on the metric, see method_for().
    std::optional<IntervalMethod> interval;
    /// Target half-width of the confidence interval of the first of `metrics`, in the unit of that
    /// metric. Replications are added until this half-width is reached. None: exactly
    /// `replications` runs.
    std::optional<double> precision;
    /// Largest number of replications of a combination of values, if `precision` is given.
    int max_replications = 1000;
    Warmup warmup;
    /// Metrics that results and pictures show first, and their file positions.
    std::vector<std::string> metrics;
    std::vector<Location> metric_places;
    /// Keys that vary, with their values, in the order of the file.
    std::vector<Vary> vary;
    /// Groups of keys (paths) that vary together: the i-th value of a key is combined only with the
    /// i-th values of the group's other keys. All other keys vary in every combination:
    ///
    ///   zip = [["radio.power", "radio.sensitivity"]]
    std::vector<std::vector<std::string>> zip;
    /// Combinations of values that the study skips.
    std::vector<Exclusion> exclude;

    /// Method of confidence intervals to use: `interval` if it is given, or else the method betting
    /// if `precision` is given. Reason: only intervals by betting stay valid when runs are added
    /// until a precision is reached. None: the default method of each metric.
    std::optional<IntervalMethod> interval_wish() const {
        if (interval || !precision) return interval;
        return IntervalMethod::betting;
    }

    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1'000'000, .text = "from 1 to 1000000"};
        constexpr Range share{.low = 0.5, .high = 0.9999, .text = "from 0.5 to 0.9999"};
        using S = StudyTable;
        return describe(field("replications", &S::replications, counts,
                              "number of replications (independent repetitions) of each "
                              "combination of values; with `precision`, the smallest number"),
                        field("confidence", &S::confidence, share,
                              "confidence level of the confidence intervals"),
                        field("interval", &S::interval,
                              "method for the confidence intervals of means: t (Student's t), "
                              "betting or star (STaR-Bets)"),
                        field("precision", &S::precision, positive,
                              "replications are added until half the width of the confidence "
                              "interval of the first metric is at most this number"),
                        field("max_replications", &S::max_replications, counts,
                              "with `precision`: the largest number of replications"),
                        field("metrics", &S::metrics,
                              "metrics that tables of results and pictures show first"));
    }
};

/// Reads [study].
/// @param duration  duration of a run; the warmup must be shorter
/// @throws InputError at the first mistake
StudyTable read_study(const Value& value, Duration duration);

/// Converts a study to a table [study], with every range expanded to a list: the inverse of
/// read_study().
Table study_document(const StudyTable& study);

}  // namespace rovernet
