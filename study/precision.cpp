// SPDX-License-Identifier: MIT
#include "study/precision.hpp"

#include "study/statistics/interval.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr std::size_t least_by_t = 10;

}  // namespace

std::string first_metric(const StudyTable& study) {
    return study.metrics.empty() ? "delivery_ratio" : study.metrics.front();
}

ReachedPrecision reached_precision(const StudyTable& study, std::span<const double> values) {
    ReachedPrecision reached{.values = values.size(), .half_width = {}};
    const auto interval = interval_of(values, bounds_of(first_metric(study)), study.confidence,
                                      study.interval_wish());
    if (interval) reached.half_width = interval->half_width();
    if (!study.precision) return reached;
    const bool early =
        interval && interval->method == IntervalMethod::t && values.size() < least_by_t;
    reached.enough = interval && !early && *reached.half_width <= *study.precision;
    return reached;
}

std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made) {
    if (!study.precision || reached_precision(study, values).enough) return made;
    const auto most = std::max(static_cast<std::uint32_t>(study.max_replications), made);
    const auto twice = std::min(2 * made, most);
    const auto needed =
        replications_for_width(values, bounds_of(first_metric(study)), *study.precision,
                               study.confidence, study.interval_wish());
    const auto estimate =
        static_cast<std::uint32_t>(std::min<std::size_t>(needed.value_or(most), most));
    const auto step = std::max(made / 16, 1U);  // so that looks are few
    return std::clamp(estimate, std::min(made + step, most), twice);
}

}  // namespace rovernet
