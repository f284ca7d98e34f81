// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace stop_test {
using namespace rovernet::test;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

/// Robots that would walk about, and talk, for years.
const std::string endless = R"([scenario]
duration = "100000000 s"
event_limit = 1000000000000000
[[robot]]
name = "r"
count = 50
place = { area = [["0 m", "0 m"], ["50 m", "50 m"]] }
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["50 m", "50 m"]], min_speed = "1 m/s", max_speed = "20 m/s" }
[[traffic]]
from = "r0"
payload = "F"
every = "1 ms"
[trace]
ns2 = "new"
)";

/// A map whose walls take long to find: every second cell is one.
std::string slow_map(const TemporaryFolder& folder) {
    constexpr std::size_t side = 5000;
    std::string bytes = "P5 5000 5000 255\n";
    for (std::size_t i = 0; i < side * side; ++i) {
        bytes += (i + i / side) % 2 == 0 ? '\0' : '\377';
    }
    return folder.write("map.pgm", bytes);
}

bool handles_signals(pid_t pid) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (!line.starts_with("SigCgt:")) continue;
        return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1) != 0;
    }
    return false;
}

/// Sends a signal to a command in the midst of its work, a while after it has begun.
Ended stopped(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
              int signal = SIGTERM, std::chrono::milliseconds after = 300ms) {
    const Process process(folder, arguments);
    for (int i = 0; i < 2000 && !handles_signals(process.pid()); ++i) {
        std::this_thread::sleep_for(5ms);
    }
    std::this_thread::sleep_for(after);
    kill(process.pid(), signal);
    return process.wait();
}

std::vector<std::string> parts_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        if (name.ends_with(".part")) names.push_back(name);
    }
    return names;
}

}  // namespace

TEST_CASE("a signal ends every long command with exit code 130, and leaves no output file") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", endless);
    const std::string end = "100000000 s";
    const std::vector<std::vector<std::string>> commands = {
        {"run", file, "--out", folder.path("out")},
        {"link", file, "r0", "r1", "--at", end},
        {"links", file, "--at", end},
        {"links", file, "--history"},
        {"routes", file, "--at", end, "--set", "routing.protocol=aodv"},
        {"where", file, "--at", end},
        {"scene", file, "--at", end},
        {"draw", file, "--trails", "--at", end, "-o", folder.path("picture.svg")},
        {"move", "convert", file, folder.path("moves.tcl")},
        {"bench", "flood", "--cpu", "100"},
    };
    for (const auto& arguments : commands) {
        CAPTURE(arguments[0]);
        const Ended ended = stopped(folder, arguments);
        CHECK(ended.exit == 130);
        CHECK(ended.err.find("interrupted") != std::string::npos);
        CHECK(parts_in(folder.path("")).empty());
        CHECK(stopped(folder, arguments, SIGHUP).exit == 130);
    }
    for (const char* written : {"picture.svg", "moves.tcl", "out/summary.json", "out/trace.tr"}) {
        CHECK_FALSE(fs::exists(folder.path(written)));
    }
}

TEST_CASE("a signal ends a command while it reads a map or sets up a run") {
    const TemporaryFolder folder;
    const std::string map = slow_map(folder);
    CHECK(stopped(folder, {"scene", map, "--size", "500x500"}).exit == 130);
    const std::string file = folder.write("s.toml", R"([scene]
map = "map.pgm"
size = ["500 m", "500 m"]
[[robot]]
name = "a"
at = ["1 m", "1 m"]
)");
    CHECK(stopped(folder, {"run", file, "--out", folder.path("out")}).exit == 130);
    CHECK_FALSE(fs::exists(folder.path("out")));
}

TEST_CASE("a signal ends a replay immediately, also while it reads or plays a long log") {
    const TemporaryFolder folder;
    std::string text = endless;
    text.replace(text.find("100000000"), 9, "240");
    text.replace(text.find("count = 50"), 10, "count = 2");
    text.replace(text.find("ns2 = \"new\""), 11, "ns2 = \"old\"");
    const std::string file = folder.write("s.toml", text);
    REQUIRE(command(folder, {"run", file, "--out", folder.path("out")}).exit == 0);
    const std::string trace = content(folder.path("out/trace.tr"));
    {
        // A trace, again and again, takes long to read.
        std::ofstream longer(folder.path("out/long.tr"), std::ios::binary);
        for (std::size_t bytes = 0; bytes < 400'000'000; bytes += trace.size()) longer << trace;
    }
    const std::string longer = folder.path("out/long.tr");
    // --verify ends where the first of them does: the fastest build takes 0.3 s to get there.
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"replay", longer, "--verify"},
             {"replay", longer, "--with", "propagation.model=friis"},
             {"replay", longer, "--speed", "1"}}) {
        CAPTURE(words[2]);
        for (const int signal : {SIGINT, SIGHUP}) {
            CHECK(stopped(folder, words, signal, 50ms).exit == 130);
        }
    }
    const std::string inputs =
        folder.write("inputs.jsonl", R"({"version":"0","scenario":"0","seed":1}
{"end_ns":90000000000000000,"fingerprint":"0"}
)");
    folder.write("scenario.toml", endless);
    CHECK(stopped(folder, {"replay", inputs, "--verify"}).exit == 130);
}

TEST_CASE("a signal immediately ends a comparison without a store, and its worker processes") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", endless);
    const Ended ended =
        stopped(folder, {"compare", file, "--models", "friis,log_distance", "--replications", "2"});
    CHECK(ended.exit == 130);
    CHECK(ended.err.find("--store") != std::string::npos);
}

TEST_CASE("a signal ends an SQL query") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", R"([study]
replications = 1
[[robot]]
name = "a"
at = ["0 m", "0 m"]
)");
    REQUIRE(command(folder, {"sweep", file}).exit == 0);
    const std::string endless_sum =
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT sum(i) FROM n";
    CHECK(stopped(folder, {"results", folder.path("s.db"), "--sql", endless_sum}).exit == 130);
    CHECK(command(folder, {"results", folder.path("s.db"), "--sql", "SELECT 1"}).exit == 0);
}

TEST_CASE(
    "two simultaneous runs into one folder: all files left in the folder belong to the same run") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const std::string file = folder.write("s.toml", R"([scenario]
duration = "2 s"
[[robot]]
name = "r"
count = 10
place = { area = [["0 m", "0 m"], ["50 m", "50 m"]] }
[[traffic]]
from = "r0"
payload = "F"
every = "10 ms"
[trace]
ns2 = "new"
)");
    const TemporaryFolder first_words, second_words;
    const Process first(first_words, {"run", file, "--out", out, "--speed", "2", "--seed", "1"});
    const Process second(second_words, {"run", file, "--out", out, "--speed", "2", "--seed", "2"});
    CHECK(first.wait().exit == 0);
    CHECK(second.wait().exit == 0);
    CHECK(parts_in(out).empty());
    const Json summary = Json::parse(content(out + "/summary.json"));
    Json of_trace = json_of(folder, {"trace", "stats", out + "/trace.tr"});
    CHECK(of_trace["receptions"] == summary["receptions"]);
    CHECK(of_trace["latency_mean_s"] == summary["latency_mean_s"]);
    const std::string seed = "seed = " + summary["seed"].dump();
    CHECK(content(out + "/scenario.toml").find(seed) != std::string::npos);
}

}  // namespace stop_test
