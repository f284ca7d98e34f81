// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace rovernet {

/// The metric that a study is foremost about: the first of its `metrics`, or delivery_ratio.
std::string first_metric(const StudyTable& study);

/// Precision of a point: how narrow the interval of its first metric is.
struct ReachedPrecision {
    std::size_t values = 0;
    std::optional<double>
        half_width;      ///< half-width, in the metric's unit; nothing where there is no interval
    bool enough = true;  ///< enough for [study] precision; also if there is none
};

/// Precision after these values, in the order of their replications.
///
/// Where the metric has two bounds the interval is valid at every n, so that one may stop as soon
/// as it is narrow. Student's t is not: values that happen to lie close together would end a point
/// too soon. So by t nothing is enough before 10 values, and never values that are all equal.
ReachedPrecision reached_precision(const StudyTable& study, std::span<const double> values);

/// Number of replications that a point needs for [study] precision, when `made` >= 1 of them are
/// over and gave these values: `made` if that is enough or there is nothing to ask for, else what
/// replications_for_width() estimates, but at least a 16th more, at most twice as many (an estimate
/// from few is rough) and never more than max_replications.
std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made);

}  // namespace rovernet
