// SPDX-License-Identifier: MIT
#include "study/precision.hpp"

#include "study/summary.hpp"

#include <algorithm>

namespace rovernet {

std::string first_metric(const StudyTable& study) {
    return study.metrics.empty() ? "delivery_ratio" : study.metrics.front();
}

std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made) {
    if (!study.precision) return made;
    const auto most = std::max(static_cast<std::uint32_t>(study.max_replications), made);
    const auto twice = std::min(2 * made, most);
    const auto summary = summary_of(values);
    if (!summary || summary->n < 2) return twice;
    if (*half_width(*summary, study.confidence) <= *study.precision) return made;
    const auto needed = replications_needed(*summary, *study.precision, study.confidence);
    const auto estimate =
        static_cast<std::uint32_t>(std::min<std::size_t>(needed.value_or(most), most));
    return std::clamp(estimate, std::min(made + 1, most), twice);
}

}  // namespace rovernet
