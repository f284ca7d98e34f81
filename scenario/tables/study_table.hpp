// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/interval_method.hpp"
#include "scenario/tables/reader.hpp"
#include "scenario/document/value.hpp"
#include "sim/fields.hpp"

#include <optional>
#include <string>
#include <vector>

// [study]: the points of a study, how often each is run and what is told of it. `rovernet sweep`
// runs it; of a plain run `warmup` and `metrics` say what is measured, all else is left alone.
//
//     [study]
//     replications = 10
//     vary."routing.ttl" = [1, 2, 3]
//     vary."radio.power" = { from = "10 dBm", to = "20 dBm", step = "5 dBm" }

namespace rovernet {

/// Key of the scenario and the values that it takes in a study.
struct Vary {
    /// Path of the key, as for --set: "radio.power", "robot.NAME.radio.power".
    std::string path;
    /// Place of the path in the file.
    Location where;
    /// Values, at least one; a range { from, to, step } is written out.
    Array values;
};

/// Points that a study leaves out: those whose keys all have one of these values. In the file:
///
///   exclude = [{ "propagation.model" = "disc", "reception.model" = "sinr" }]
using Exclusion = std::vector<Vary>;

/// Time after which measuring begins.
struct Warmup {
    /// Time since the start of the run [ns]; messages that are sent before do not count.
    Duration given{0};
    /// The time is found by MSER-5 in each run instead.
    bool mser5 = false;
};

/// [study], and what it says of points and metrics.
struct StudyTable {
    /// Independent repetitions of each point, at least.
    int replications = 1;
    /// Probability that an interval covers the true mean [-].
    double confidence = 0.95;
    /// Method of intervals; by default it depends on the metric, see method_for().
    std::optional<IntervalMethod> interval;
    /// Half-width of the interval of the first metric, in its unit, until which runs are added;
    /// none: `replications` runs, and no more.
    std::optional<double> precision;
    /// Repetitions for `precision` at most.
    int max_replications = 1000;
    Warmup warmup;
    /// Metrics that results and pictures show first, and where each is named.
    std::vector<std::string> metrics;
    std::vector<Location> metric_places;
    /// Keys that vary, in the order of the file.
    std::vector<Vary> vary;
    /// Groups of paths that vary together, value by value; all others vary in every combination:
    ///
    ///   zip = [["radio.power", "radio.sensitivity"]]
    std::vector<std::vector<std::string>> zip;
    /// Points that are left out.
    std::vector<Exclusion> exclude;

    /// Method that intervals are asked for: `interval`, or betting where runs are added until a
    /// precision is reached, which only betting allows.
    std::optional<IntervalMethod> interval_wish() const {
        if (interval || !precision) return interval;
        return IntervalMethod::betting;
    }

    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1'000'000, .text = "from 1 to 1000000"};
        constexpr Range share{.low = 0.5, .high = 0.9999, .text = "from 0.5 to 0.9999"};
        using S = StudyTable;
        return describe(
            field("replications", &S::replications, counts, "independent repetitions, at least"),
            field("confidence", &S::confidence, share, "of the intervals"),
            field("interval", &S::interval,
                  "of means: t, betting or star; by default star where a metric has two bounds"),
            field("precision", &S::precision, positive,
                  "repeats until the interval of the first metric has this half-width"),
            field("max_replications", &S::max_replications, counts, "for precision, at most"),
            field("metrics", &S::metrics, "what results and pictures show first"));
    }
};

/// Reads [study].
/// @param duration  of a run; a warmup must be shorter
/// @throws InputError at the first mistake
StudyTable read_study(const Value& value, Duration duration);

/// Table that reads back as the same study, with every list written out.
Table study_document(const StudyTable& study);

}  // namespace rovernet
