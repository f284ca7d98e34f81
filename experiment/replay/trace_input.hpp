// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A trace of either kind as ns-2 text: a file that has it, or a recorded trace, of which the text
/// is made while it is read. What reads ns-2 traces reads both.
///
///     TraceInput trace("runs/rescue-s7/trace.mcap", {.format = Ns2Format::old_format});
///     const TraceStats stats = ns2_stats(trace.text());
///     for (const std::string& what : trace.damage()) notice(what);
class TraceInput {
  public:
    /// Form of the lines that are made of a recorded trace.
    struct Lines {
        Ns2Format format = Ns2Format::new_format;
        /// Whether lines of the MAC are made; if not given, as `[trace] mac` of its scenario says.
        std::optional<MacTrace> mac = {};
    };

    /// @throws InputError if the file cannot be read
    TraceInput(const std::string& path, Lines lines);

    bool is_recorded() const { return recorded_ != nullptr; }
    /// The text, to be read once. @throws InputError if the file cannot be read
    Ns2Source text() const;
    /// Names of the robots by their numbers; of a recorded trace only.
    const std::vector<std::string>& robots() const;
    /// What is broken or missing in what was read so far of a recorded trace; empty: nothing.
    const std::vector<std::string>& damage() const;

  private:
    struct Recorded;

    std::string path_;
    std::shared_ptr<Recorded> recorded_;  // null: a file of ns-2 text
};

/// Writes the ns-2 trace that the run of a recorded trace would have written, to the byte.
/// @return what is broken or missing in the recorded trace
/// @throws InputError, RunError
std::vector<std::string> render_recorded(const std::string& in, const std::string& out,
                                         TraceInput::Lines lines);

}  // namespace rovernet
