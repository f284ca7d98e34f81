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

// The command `live` as tests run it, and what its clients say first.

namespace rovernet::test {

/// Three robots in a row, of which neighbours hear one another; A says something now and then.
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

/// Scenario of live_row, for a longer time.
inline std::string long_live_row() {
    std::string text = live_row;
    return text.replace(text.find("2 s"), 3, "9999 s");
}

inline int read_port(const std::string& line) {
    const std::string host = "127.0.0.1:";
    return std::stoi(line.substr(line.find(host) + host.size()));
}

/// The line of standard output of a command in a folder that begins and ends so; waits for it.
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

/// A live run in the background.
class Live {
  public:
    /// @param options  in which SOCKET and PIDFILE stand for files in the folder
    /// @param program  text of the Python program that is meant by "PROGRAM" in an option
    explicit Live(std::vector<std::string> options, const std::string& file = live_row,
                  const std::string& program = {})
        : process_(folder, arguments(std::move(options), file, program)) {}

    /// Port that it says it listens on; waits for that.
    /// @param what  end of that line: "(rosbridge)"
    int port(const std::string& what = {}) const {
        return read_port(said("listening on 127.0.0.1:", what));
    }
    /// The line of standard output that begins and ends so.
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

/// First line of a controller. @param robots  "\"A\",\"B\""
inline std::string hello(const std::string& robots, const std::string& step = "100 ms") {
    return R"({"type":"hello","protocol":1,"robots":[)" + robots + R"(],"step":")" + step + "\"}";
}

/// The next message of a Player server.
inline Wire message_of(LineClient& client) {
    std::string bytes = client.bytes(40);
    REQUIRE(bytes.size() == 40);
    bytes += client.bytes(number_at(bytes, 36, 4));
    return take_messages(bytes).at(0);
}

/// Opens position2d of the first robot, to pull.
inline void open_position(LineClient& client) {
    CHECK(client.bytes(32).starts_with("Player v."));
    client.send_bytes(mode(pull) + device(4, 0));
    for (int i = 0; i < 2; ++i) CHECK(message_of(client).type == ack);
}

}  // namespace rovernet::test
