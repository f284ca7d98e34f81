// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Result of replaying the inputs of a run.
struct InputReplay {
    std::uint64_t inputs = 0;
    std::string recorded;     ///< fingerprint in the input log; empty if the run did not finish
    std::string now;          ///< fingerprint of the replayed run
    std::string recorded_by;  ///< version of rovernet that wrote the log

    std::string log;                  ///< path of the input log
    std::vector<std::string> others;  ///< incomplete logs (part files) beside the log
    /// Number of the log's last line, from 1, if this line is incomplete; none: it is complete.
    std::optional<int> torn;
    /// True: scenario.toml is missing, or differs from the scenario of the run.
    bool is_other_scenario = false;
    bool has_own_scenario = false;  ///< true: the scenario is the text in the log, not the file
};

/// Whether the path is an input log, an incomplete input log (part file), or a folder, which should
/// contain such a file.
bool has_input_log(const std::string& path);

/// Runs a scenario again with the inputs of an input log, as fast as possible. The scenario is the
/// file scenario.toml beside the log, or the text in the log if that file is missing or differs.
/// @param path      input log or part file; or a folder, with its log or else its newest part file
/// @param progress  called with the finished share, 0 ... 1; returning false stops the replay
/// @throws InputError for an invalid line of the log; RunError; Interrupted if `progress` returns
///         false
InputReplay replay_inputs(const std::string& path, const std::function<bool(double)>& progress);

}  // namespace rovernet
