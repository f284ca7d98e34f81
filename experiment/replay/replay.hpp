// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metrics.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// What came out when the scenario of a trace was run again.
struct Verification {
    /// First line that differs: of a recorded trace as append_text() writes it; empty: the other
    /// had no more.
    struct Difference {
        std::string recorded, now;
    };
    /// Records, or lines of an ns-2 trace, that were the same, up to the first difference.
    std::uint64_t same = 0;
    std::string_view unit = "records";  ///< "records" or "lines"
    std::optional<Difference> difference;
    /// Version that recorded it (empty: the trace does not say), and this one.
    std::string recorded_by, version;
    /// What is broken or missing in the trace.
    std::vector<std::string> damage;
};

/// Runs the scenario of a trace again, and compares: every record of a recorded trace, whose
/// scenario is inside; every line of an ns-2 trace that rovernet wrote, whose scenario is the
/// `scenario.toml` beside it.
/// @param progress  told the share that is done, 0 ... 1; false stops it
/// @throws InputError, RunError, Interrupted
Verification verify_replay(const std::string& path, const std::function<bool(double)>& progress);

/// Metrics of a recorded trace: those of the run that wrote it, without its warm-up.
/// @param damage  gets what is broken or missing in the trace
/// @throws InputError
MetricValues recorded_metrics(const std::string& path, std::vector<std::string>& damage);

}  // namespace rovernet
