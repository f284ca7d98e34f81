// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Trace as ns-2 text. The file is an ns-2 trace, or a recorded trace, whose text is generated
/// during reading. So every reader of ns-2 traces can also read recorded traces.
///
///     TraceInput trace("runs/rescue-s7/trace.mcap", {.format = Ns2Format::old_format});
///     const TraceStats stats = ns2_stats(trace.text());
///     for (const std::string& what : trace.damage()) notice(what);
class TraceInput {
  public:
    /// Options of the ns-2 lines that are generated from a recorded trace.
    struct Lines {
        Ns2Format format = Ns2Format::new_format;
        /// Choice whether lines of the MAC layer are generated; none: as the key mac of [trace] in
        /// the scenario of the trace selects.
        std::optional<MacTrace> mac = {};
        bool motion = true;  ///< whether movements are generated, the lines M
    };

    /// @throws InputError if the file cannot be read
    TraceInput(const std::string& path, Lines lines);

    bool is_recorded() const { return recorded_ != nullptr; }
    /// Text of the trace. The text can be read only once. @throws InputError if the file cannot be
    /// read
    Ns2Source text() const;
    /// Names of the robots, by robot number; only for recorded traces.
    const std::vector<std::string>& robots() const;
    /// Sentences about broken or missing parts of a recorded trace, as far as it was read; empty if
    /// no part is broken or missing.
    const std::vector<std::string>& damage() const;

  private:
    struct Recorded;

    std::string path_;
    std::shared_ptr<Recorded> recorded_;  // recorded trace; null: the trace is a file of ns-2 text
};

/// Writes the ns-2 trace of a recorded run, byte for byte as the run would have written it.
/// @param in, out  paths of the recorded trace and of the ns-2 trace
/// @return sentences about broken or missing parts of the recorded trace
/// @throws InputError, RunError
std::vector<std::string> render_recorded(const std::string& in, const std::string& out,
                                         TraceInput::Lines lines);

}  // namespace rovernet
