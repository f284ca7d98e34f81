// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "files/part_file.hpp"
#include "live/carriers/json_line.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

// Log of the inputs of a live run, inputs.jsonl in its folder: it makes the run again. One JSON
// object a line; the first has version, scenario (a digest of it, and its text) and seed, the last
// the end and the fingerprint:
//
//     {"version":"0.1.0","scenario":"8c5d...","seed":1,"toml":"[scenario]\nname = ..."}
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

/// Digest by which a log knows its scenario.
std::string text_digest(const std::string& text);

/// Writer of a log. Until finish() it is a part, inputs.jsonl.N.part, to which what came in is
/// added every second: that of a run that is killed, or fails, replays as far as it goes. Nobody
/// removes such a part but whoever no longer wants it.
class InputLog {
  public:
    /// Begins it, and writes scenario.toml if the folder has no results yet.
    /// @param folder  of the run
    /// @throws RunError if a file cannot be written
    InputLog(const std::string& folder, const Scenario& scenario);
    /// Keeps the part and the scenario, if there is any input and they are not discarded.
    ~InputLog();
    InputLog(const InputLog&) = delete;
    InputLog& operator=(const InputLog&) = delete;

    /// Adds an input. @throws RunError
    void add(const Input& input, const Network& network);
    /// Writes what is a second old: to be called now and then. @throws RunError
    void keep_up();
    /// Has both removed with its object: the run begins anew.
    void discard();
    /// Writes the last line, and gives the file its name. @throws RunError
    void finish(Duration simulated, std::string_view fingerprint);

  private:
    using Clock = std::chrono::steady_clock;
    void flush();

    PartFile file_;
    JsonLine lines_;           // not written yet
    bool has_inputs_ = false;  // that are worth a part
    bool is_finished_ = false;
    std::filesystem::path scenario_;  // the one that it has written
    Clock::time_point written_ = Clock::now();
};

}  // namespace rovernet
