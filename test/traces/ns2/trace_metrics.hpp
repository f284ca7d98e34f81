// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metrics.hpp"
#include "traces/ns2/ns2_reader.hpp"

#include <memory>
#include <utility>

namespace rovernet::testing {

/// Metrics of an ns-2 trace. They equal the metrics of the run that wrote the trace, to the last
/// digit.
/// @throws InputError as read_ns2_trace()
inline MetricValues trace_metrics(Ns2Source source,
                                  Ns2Strictness strictness = Ns2Strictness::tolerant) {
    const auto metrics = std::make_shared<Metrics>();
    read_ns2_trace(std::move(source), metrics, strictness);
    return metrics->values();
}

}  // namespace rovernet::testing
