// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "files/part_file.hpp"
#include "live/carriers/json_line.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

// Log of the inputs (commands) of a live run, for replay: inputs.jsonl in the run's folder. One
// JSON object per line. The first line has format, version, scenario (digest and text) and seed.
// The last line has end time and fingerprint. Commands have the keys of the lock-step protocol:
//
//     {"format":2,"version":"0.1.0","scenario":"8c5d...","seed":1,"toml":"[scenario]\nname = ..."}
//     {"t_ns":100000000,"n":1,"client":"A","robot":"A","do":{"v":0.5,"w":0.1,"timeout":"0.5 s"}}
//     {"t_ns":200000000,"n":2,"client":"A","robot":"A","do":{"to":"*","port":7,"data":"Rg==",...}}
//     {"t_ns":200000000,"n":2,"client":"A","robot":"B","do":{"goal":[1.0,12.0,0.0],"speed":1.5}}
//     {"t_ns":300000000,"n":3,"client":"A","robot":"A","do":{"stop":true}}
//     {"end_ns":300000000,"fingerprint":"b13b..."}
//
// A log without the key `format` has format 1, which is still read.

namespace rovernet {

class Network;

/// File name of the input log in the folder of the run.
inline constexpr std::string_view input_log_name = "inputs.jsonl";

/// Format number in the first line of every input log that is written.
inline constexpr std::int64_t input_log_format = 2;

/// Digest of a scenario's text, stored in the input log.
std::string text_digest(const std::string& text);

/// Writer of an input log. Until finish() the file has the name inputs.jsonl.N.part, and inputs are
/// written to it every second. The part file of a killed or failed run can be replayed up to its
/// end. Part files are never removed automatically.
class InputLog {
  public:
    /// Starts the input log, and writes scenario.toml if the folder has no results yet.
    /// @param folder  folder of the run
    /// @throws RunError if a file cannot be written
    InputLog(const std::string& folder, const Scenario& scenario);
    /// Without finish(), keeps the part file and scenario.toml if inputs were added and discard()
    /// was not called; otherwise removes these files. No effect after finish().
    ~InputLog();
    InputLog(const InputLog&) = delete;
    InputLog& operator=(const InputLog&) = delete;

    /// Adds an input (robot command) to the log. @throws RunError
    void add(const Input& input, const Network& network);
    /// Writes inputs older than 1 s to the part file; must be called repeatedly. @throws RunError
    void keep_up();
    /// Makes the destructor remove the part file and scenario.toml. Called if the run starts again.
    void discard();
    /// Writes the last line of the log, and gives the file its final name. @throws RunError
    void finish(Duration simulated, std::string_view fingerprint);

  private:
    using Clock = std::chrono::steady_clock;
    void flush();

    PartFile file_;
    JsonLine lines_;           // log lines not written to the file yet
    bool has_inputs_ = false;  // whether inputs were added, so that the part file is kept
    bool is_finished_ = false;
    std::filesystem::path scenario_;  // scenario.toml, if written by this log
    Clock::time_point written_ = Clock::now();
};

}  // namespace rovernet
