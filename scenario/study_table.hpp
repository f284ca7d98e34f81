// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/interval_method.hpp"
#include "scenario/reader.hpp"
#include "scenario/value.hpp"
#include "sim/fields.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A key of the scenario and the values that it takes in a study.
struct Vary {
    std::string path;  ///< as for --set: "radio.power", "robot.NAME.radio.power"
    Location where;
    Array values;  ///< at least one
};

/// What a study leaves out: the points whose keys all have one of these values.
using Exclusion = std::vector<Vary>;

/// When measuring begins.
struct Warmup {
    Duration given{0};
    bool mser5 = false;  ///< found by MSER-5 in each run instead
};

/// [study]
struct StudyTable {
    int replications = 1;
    double confidence = 0.95;
    std::optional<IntervalMethod> interval;  ///< by the metric if not given: see method_for()
    std::optional<double> precision;
    int max_replications = 1000;
    Warmup warmup;
    std::vector<std::string> metrics;
    std::vector<Location> metric_places;  ///< where each of them is named
    std::vector<Vary> vary;
    std::vector<std::vector<std::string>> zip;  ///< paths that vary together, value by value
    std::vector<Exclusion> exclude;

    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1'000'000, .text = "from 1 to 1000000"};
        constexpr Range share{.low = 0.5, .high = 0.9999, .text = "from 0.5 to 0.9999"};
        using S = StudyTable;
        return describe(
            field("replications", &S::replications, counts, "independent repetitions, at least"),
            field("confidence", &S::confidence, share, "of the intervals"),
            field("interval", &S::interval,
                  "of means: t or betting; by default betting where a metric has two bounds"),
            field("precision", &S::precision, positive,
                  "repeats until the interval of the first metric has this half-width"),
            field("max_replications", &S::max_replications, counts, "for precision, at most"),
            field("metrics", &S::metrics, "what results and pictures show first"));
    }
};

/// Reads [study] of a scenario whose run takes `duration`. @throws InputError at the first mistake
StudyTable read_study(const Value& value, Duration duration);

/// The reverse, with every list written out.
Table study_document(const StudyTable& study);

}  // namespace rovernet
