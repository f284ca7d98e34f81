// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Trace of either kind as ns-2 text: an ns-2 trace file, or a recorded trace, whose text is
/// generated during reading. Every reader of ns-2 traces can read both.
///
///     TraceInput trace("runs/rescue-s7/trace.mcap", {.format = Ns2Format::old_format});
///     const TraceStats stats = ns2_stats(trace.text());
///     for (const std::string& what : trace.damage()) notice(what);
class TraceInput {
  public:
    /// Format of the lines that are generated from a recorded trace.
    struct Lines {
        Ns2Format format = Ns2Format::new_format;
        /// Whether MAC lines are generated; none: as [trace] mac of the scenario in the trace.
        std::optional<MacTrace> mac = {};
    };

    /// @throws InputError if the file cannot be read
    TraceInput(const std::string& path, Lines lines);

    bool is_recorded() const { return recorded_ != nullptr; }
    /// Text of the trace; can be read once. @throws InputError if the file cannot be read
    Ns2Source text() const;
    /// Names of the robots, by number; recorded traces only.
    const std::vector<std::string>& robots() const;
    /// Broken or missing parts of a recorded trace, as far as it was read; empty: none.
    const std::vector<std::string>& damage() const;

  private:
    struct Recorded;

    std::string path_;
    std::shared_ptr<Recorded> recorded_;  // null: a file of ns-2 text
};

/// Writes the ns-2 trace of a recorded run, byte for byte as the run would have written it.
/// @return broken or missing parts of the recorded trace
/// @throws InputError, RunError
std::vector<std::string> render_recorded(const std::string& in, const std::string& out,
                                         TraceInput::Lines lines);

}  // namespace rovernet
