// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace rovernet {

/// Main metric of a study: the first of its `metrics`, or delivery_ratio.
std::string first_metric(const StudyTable& study);

/// Precision reached at a point of a study: half-width of the interval of the first metric.
struct ReachedPrecision {
    std::size_t values = 0;
    /// Half-width of the interval, in the metric's unit; none without an interval.
    std::optional<double> half_width;
    bool enough = true;  ///< true if [study] precision is reached or not given
};

/// Precision reached by these values of the study's first metric, in the order of replications.
///
/// If the metric has two bounds, the betting interval is valid at every n, so that a point may stop
/// as soon as it is narrow. Student's t is not: values that are close by chance would stop a point
/// too early. By t, at least 10 values are needed, and equal values never suffice.
ReachedPrecision reached_precision(const StudyTable& study, std::span<const double> values);

/// Number of replications that a point needs for [study] precision, after `made` >= 1 replications
/// with these values. The result is `made` if the precision is reached or not given. Otherwise it
/// is the estimate of replications_for_width(), limited to between 17/16 and 2 times `made`
/// (estimates from few values are rough) and to max_replications.
std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made);

}  // namespace rovernet
