// SPDX-License-Identifier: MIT
#pragma once

#include "test/cli/process.hpp"
#include "test/live/line_client.hpp"
#include "test/live/player/wire.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Functions that run the command `live` in tests, and the first messages of its clients.

namespace rovernet::test {

/// Scenario of three robots in a row. Only neighbours hear each other, and A sends messages at
/// times.
inline const std::string live_row = R"([scenario]
name = "row"
duration = "2 s"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["15 m", "0 m"]
[[robot]]
name = "C"
at = ["30 m", "0 m"]
[[traffic]]
from = "A"
payload = "tick"
every = "0.3 s"
)";

/// Scenario live_row with a longer run.
inline std::string long_live_row() {
    std::string text = live_row;
    return text.replace(text.find("2 s"), 3, "9999 s");
}

inline int read_port(const std::string& line) {
    const std::string host = "127.0.0.1:";
    return std::stoi(line.substr(line.find(host) + host.size()));
}

/// Waits for a line of the command's standard output that begins with `words` and ends with
/// `last_words`, and returns the line.
inline std::string said(const TemporaryFolder& folder, const std::string& words,
                        const std::string& last_words = {}) {
    using namespace std::chrono_literals;
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(5ms)) {
        std::ifstream out(folder.path("stdout"));
        for (std::string line; std::getline(out, line);) {
            const bool is_it = line.starts_with(words) && line.ends_with(last_words);
            if (is_it && !out.eof()) return line;
        }
    }
    FAIL("it does not say " << words << ": " << content(folder.path("stderr")));
    return {};
}

/// Process of `rovernet live` in the background.
class Live {
  public:
    /// @param options  options of the command; SOCKET and PIDFILE stand for files in the folder
    /// @param program  text of the Python program for which PROGRAM stands in an option
    explicit Live(std::vector<std::string> options, const std::string& file = live_row,
                  const std::string& program = {})
        : process_(folder, arguments(std::move(options), file, program)) {}

    /// Port at which the command listens, from its output; waits for the line.
    /// @param what  end of the line, such as "(rosbridge)"
    int port(const std::string& what = {}) const {
        return read_port(said("listening on 127.0.0.1:", what));
    }
    /// Line of standard output that begins with `words` and ends with `last_words`.
    std::string said(const std::string& words, const std::string& last_words = {}) const {
        return test::said(folder, words, last_words);
    }
    Ended wait() const { return process_.wait(); }
    const Process& process() const { return process_; }
    std::string fingerprint() const {
        return Json::parse(content(folder.path("out/summary.json"))).at("fingerprint");
    }
    Ended replay() const { return command(folder, {"replay", folder.path("out"), "--verify"}); }

    TemporaryFolder folder;

  private:
    std::vector<std::string> arguments(std::vector<std::string> options, const std::string& file,
                                       const std::string& program) {
        options.insert(options.begin(),
                       {"live", folder.write("s.toml", file), "--out", folder.path("out")});
        const std::pair<std::string, std::string> meanings[] = {
            {"SOCKET", folder.path("socket")},
            {"PIDFILE", folder.path("pid")},
            {"PROGRAM", "python3 " + folder.write("c.py", program)}};
        for (std::string& option : options) {
            for (const auto& [word, meaning] : meanings) {
                for (auto at = option.find(word); at != option.npos; at = option.find(word, at)) {
                    option.replace(at, word.size(), meaning);
                    at += meaning.size();
                }
            }
        }
        return options;
    }

    Process process_;
};

/// Resident memory of a process [MiB].
inline long megabytes_of(pid_t pid) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) return std::stol(line.substr(6)) / 1024;
    }
    return 0;
}

/// First line that a controller sends. @param robots  names, such as "\"A\",\"B\""
inline std::string hello(const std::string& robots, const std::string& step = "100 ms") {
    return R"({"type":"hello","protocol":1,"robots":[)" + robots + R"(],"step":")" + step + "\"}";
}

/// Next message of a Player server.
inline Wire message_of(LineClient& client) {
    std::string bytes = client.bytes(40);
    REQUIRE(bytes.size() == 40);
    bytes += client.bytes(number_at(bytes, 36, 4));
    return take_messages(bytes).at(0);
}

/// Opens position2d of the first robot, in PULL mode.
inline void open_position(LineClient& client) {
    CHECK(client.bytes(32).starts_with("Player v."));
    client.send_bytes(mode(pull) + device(4, 0));
    for (int i = 0; i < 2; ++i) CHECK(message_of(client).type == ack);
}

}  // namespace rovernet::test
