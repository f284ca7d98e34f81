// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace rovernet {

/// Name of a study's main metric: the first metric in [study] metrics, or else delivery_ratio.
std::string first_metric(const StudyTable& study);

/// Precision reached at a point of a study: half-width of the confidence interval of the study's
/// main metric, see first_metric().
struct ReachedPrecision {
    std::size_t values = 0;
    /// Half-width of the confidence interval, in the metric's unit; none: no interval exists.
    std::optional<double> half_width;
    bool enough = true;  ///< true if [study] precision is reached or not given
};

/// Precision reached by values of the study's main metric (see first_metric()) at one point.
///
/// For a metric with two bounds, the default is the betting interval, which is valid after any
/// number of replications. A point therefore needs no more runs once its interval is narrow enough.
/// Student's t interval is valid only for a fixed number of replications: values that are close by
/// chance would end a point too early. With t, at least 10 values are needed, and equal values
/// never suffice.
/// @param values  in the order of the replications
ReachedPrecision reached_precision(const StudyTable& study, std::span<const double> values);

/// Estimated number of replications that a point needs for [study] precision. If the precision is
/// reached or not given, the result is `made`. Otherwise replications_for_width() gives the result,
/// limited to between 17/16 and 2 times `made` (estimates from few values are rough) and to
/// max_replications.
/// @param made  number of replications so far, >= 1, with these values
std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made);

}  // namespace rovernet
