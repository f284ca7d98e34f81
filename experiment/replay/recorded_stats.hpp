// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_stats.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Statistics of a recorded trace.
struct RecordedStats {
    /// Statistics: counts of ns-2 lines (including MAC lines), metrics, and drops of the run.
    /// Metrics and drops exclude the warm-up; counts of lines include it.
    TraceStats stats;
    /// Number of receptions in the whole file, including duplicates and the warm-up.
    std::uint64_t receptions = 0;
    std::uint64_t file_bytes = 0;  ///< size of the trace file [bytes]
    /// Sentences about broken or missing parts of the trace.
    std::vector<std::string> damage;
};

/// Computes statistics from the records of a trace. The result equals ns2_stats() on the ns-2 text
/// of the run. This text is generated only if some record has no valid ns-2 line.
/// @throws InputError as read_ns2_trace() and recorded_metrics()
RecordedStats recorded_stats(const std::string& path,
                             Ns2Strictness strictness = Ns2Strictness::tolerant,
                             TraceRows rows = TraceRows::none);

/// Computes statistics from the ns-2 text of a recorded trace. This slow function is the reference
/// for recorded_stats() in tests.
RecordedStats recorded_stats_of_text(const std::string& path, Ns2Strictness strictness,
                                     TraceRows rows);

}  // namespace rovernet
