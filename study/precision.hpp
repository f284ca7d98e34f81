// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/study_table.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace rovernet {

/// The metric that a study is foremost about: the first of its `metrics`, or delivery_ratio.
std::string first_metric(const StudyTable& study);

/// How many replications a point needs for [study] precision, when `made` >= 1 of them are over
/// and gave these values: `made` if that is enough or there is nothing to ask for, else what
/// replications_needed() estimates, but at most twice as many (an estimate from few is rough) and
/// never more than max_replications. Fewer than 2 values ask for twice as many.
std::uint32_t replications_for(const StudyTable& study, std::span<const double> values,
                               std::uint32_t made);

}  // namespace rovernet
