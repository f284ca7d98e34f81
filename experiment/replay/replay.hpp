// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metrics.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Result of running the scenario of a trace again and comparing its records with the trace.
struct Verification {
    /// First difference: a record of the trace and the record of the new run, each as an ns-2 line
    /// or as the text of append_text(). The text is empty if the respective run has already ended.
    struct Difference {
        std::string recorded, now;
    };
    /// Number of equal records (or lines of an ns-2 trace) before the first difference.
    std::uint64_t same = 0;
    std::string_view unit = "records";  ///< unit of `same`: "records" or "lines"
    std::optional<Difference> difference;
    /// Version of rovernet that recorded the trace (empty: unknown), and version of this program.
    std::string recorded_by, version;
    /// Sentences about broken or missing parts of the trace.
    std::vector<std::string> damage;

    /// Whether the new run reproduces the whole recorded run. True if there is no difference, and
    /// no part of the trace is missing.
    bool is_identical() const { return !difference && damage.empty(); }
};

/// Runs the scenario of a trace again, and compares the new run with the trace. For a recorded
/// trace, which contains its scenario, every record is compared. For an ns-2 trace of rovernet,
/// whose scenario is the file `scenario.toml` in the same folder, every line is compared.
/// @param progress  called with the finished share, 0 ... 1; returning false stops the run
/// @throws InputError, RunError, Interrupted
Verification verify_replay(const std::string& path, const std::function<bool(double)>& progress);

/// Sink that computes metrics from the records of a trace. The sink excludes the warm-up, like the
/// sink of the recorded run.
/// @throws InputError if the scenario of the trace cannot be loaded
Metrics metrics_of(const RecordedRun& run, const std::string& path);

/// Metrics of a recorded trace, without the warm-up: equal to the metrics of the run that wrote the
/// trace.
/// @param damage  receives sentences about broken or missing parts of the trace
/// @throws InputError
MetricValues recorded_metrics(const std::string& path, std::vector<std::string>& damage);

}  // namespace rovernet
