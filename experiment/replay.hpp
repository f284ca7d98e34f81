// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metrics.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What came out when the scenario inside a recorded trace was run again.
struct Verification {
    /// First line that differs, as append_text() writes it; empty: the other had no more.
    struct Difference {
        std::string recorded, now;
    };
    /// Records that were the same, up to the first difference.
    std::uint64_t records = 0;
    std::optional<Difference> difference;
    /// Version that recorded it, and this one.
    std::string recorded_by, version;
    /// What is broken or missing in the trace.
    std::vector<std::string> damage;
};

/// Runs the scenario inside a recorded trace, and compares every record with the trace's.
/// @param progress  told the share that is done, 0 ... 1; false stops it
/// @throws InputError, RunError, Interrupted
Verification verify_replay(const std::string& path, const std::function<bool(double)>& progress);

/// Metrics of a recorded trace: those of the run that wrote it, without its warm-up.
/// @param damage  gets what is broken or missing in the trace
/// @throws InputError
MetricValues recorded_metrics(const std::string& path, std::vector<std::string>& damage);

}  // namespace rovernet
