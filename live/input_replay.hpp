// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What came out when the inputs of a run were carried out again.
struct InputReplay {
    std::uint64_t inputs = 0;
    std::string recorded;     ///< fingerprint that the log has; empty if the run did not end
    std::string now;          ///< fingerprint of the replay
    std::string recorded_by;  ///< version

    std::string log;                  ///< path of the log that was read
    std::vector<std::string> others;  ///< parts beside it, of runs that did not end
    std::optional<int> torn;          ///< last line, which was not written to its end
    bool is_other_scenario = false;   ///< scenario.toml is not the one that was run, or not there
    bool has_own_scenario = false;    ///< then the text in the log was run
};

/// Whether the path is a folder with a log or a part of one, or is one itself.
bool has_input_log(const std::string& path);

/// Runs a scenario again with the inputs of its log, unpaced. It is the scenario.toml beside the
/// log, or the log's own text if that file is not as it was run.
/// @param path      log, or a part of one; or a folder: its log, or else its newest part
/// @param progress  told the share that is done, 0 ... 1; false stops it
/// @throws InputError with the line of the log that is wrong; RunError, Interrupted
InputReplay replay_inputs(const std::string& path, const std::function<bool(double)>& progress);

}  // namespace rovernet
