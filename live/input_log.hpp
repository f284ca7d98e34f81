// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "files/part_file.hpp"
#include "live/json_line.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

// Log of the inputs of a live run, inputs.jsonl in its folder: with scenario.toml it makes the run
// again. One JSON object a line; the first has version, scenario and seed, the last the end and the
// fingerprint:
//
//     {"version":"0.1.0","scenario":"8c5d...","seed":1}
//     {"t_ns":100000000,"n":1,"client":"A","robot":"A","do":"velocity","v":0.5,"w":0.1}
//     {"t_ns":200000000,"n":2,"client":"A","robot":"A","do":"send","to":"*","port":7,"data":"Rg=="}
//     {"t_ns":200000000,"n":2,"client":"A","robot":"A","do":"send","to":"*","hops":1,"port":0,...}
//     {"t_ns":200000000,"n":2,"client":"A","robot":"B","do":"goal","goal":[1,12,0],"speed":1.5}
//     {"t_ns":300000000,"n":3,"client":"A","robot":"A","do":"stop"}
//     {"t_ns":300000000,"n":4,"client":"A","robot":"B","do":"place","at":[1,12,0],"heading":1.57}
//     {"end_ns":300000000,"fingerprint":"b13b..."}

namespace rovernet {

class Network;

/// Name of the log in the folder of its run.
inline constexpr std::string_view input_log_name = "inputs.jsonl";

/// Writer of a log, of which a part is there every second: that of a run that is killed replays as
/// far as it goes.
class InputLog {
  public:
    /// @param folder  of the run
    /// @throws RunError if the file cannot be written
    InputLog(const std::string& folder, const Scenario& scenario);

    /// Adds an input. @throws RunError
    void add(const Input& input, const Network& network);
    /// Writes the last line, and gives the file its name. @throws RunError
    void finish(Duration simulated, std::string_view fingerprint);

  private:
    using Clock = std::chrono::steady_clock;
    void flush();

    PartFile file_;
    JsonLine lines_;  // not written yet
    Clock::time_point written_ = Clock::now();
};

/// What came out when the inputs of a run were carried out again.
struct InputReplay {
    std::uint64_t inputs = 0;
    std::string recorded;            ///< fingerprint that the log has; empty if it was cut
    std::string now;                 ///< fingerprint of the replay
    std::string recorded_by;         ///< version
    bool is_other_scenario = false;  ///< scenario.toml is not the one that was run
};

/// Whether the path is a folder with a log, or a log.
bool has_input_log(const std::string& path);

/// Runs scenario.toml again with the inputs of the log beside it, unpaced.
/// @param path      folder of the run, or its log
/// @param progress  told the share that is done, 0 ... 1; false stops it
/// @throws InputError with the line of the log that is wrong; RunError, Interrupted
InputReplay replay_inputs(const std::string& path, const std::function<bool(double)>& progress);

}  // namespace rovernet
