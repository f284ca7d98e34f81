// SPDX-License-Identifier: MIT
// Runs that are killed, or that fail: their inputs so far make them again.
#include "live/input_replay.hpp"
#include "live/player/listeners.hpp"
#include "sim/error.hpp"
#include "test/live/live_command.hpp"
#include "test/live/served_run.hpp"
#include "test/live/talk.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace killed_run_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> parts_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".part") names.push_back(entry.path());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The number of whole lines in a file.
std::ptrdiff_t lines_in(const std::string& path) {
    const std::string text = content(path);
    return std::count(text.begin(), text.end(), '\n');
}

/// A live run into a folder, one of whose robots is driven, that is killed. @return its part
std::string run_and_kill(const TemporaryFolder& words, const std::string& folder,
                         const std::string& seed, int commands) {
    const std::string file = words.write("s.toml", long_live_row());
    const Process process(
        words, {"live", file, "--listen-json", "127.0.0.1:0", "--out", folder, "--seed", seed});
    LineClient client(read_port(said(words, "listening on ")));
    client.ask(hello("\"A\""));
    for (int n = 1; n <= commands; ++n) {
        const std::string number = std::to_string(n);
        client.ask(R"({"type":"step","n":)" + number + R"(,"do":{"A":{"v":0.)" + number + "}}}");
    }
    const std::string part = folder + "/inputs.jsonl." + std::to_string(process.pid()) + ".part";
    // The client is silent now; all of its words are in the file a second later.
    for (int i = 0; i < 1000 && lines_in(part) <= commands; ++i) std::this_thread::sleep_for(10ms);
    CHECK(lines_in(part) == commands + 1);
    kill(process.pid(), SIGKILL);
    process.wait();
    return part;
}

}  // namespace

TEST_CASE("killed run: a killed run is replayed from its folder or its unfinished input log") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const std::string part = run_and_kill(folder, out, "5", 9);
    CHECK(content(out + "/scenario.toml").find("seed = 5") != std::string::npos);
    CHECK_FALSE(fs::exists(out + "/summary.json"));
    const InputReplay replay = replay_inputs(out, {});
    CHECK(replay.log == part);
    CHECK(replay.inputs == 9);
    CHECK(replay.recorded.empty());
    CHECK_FALSE(replay.torn);
    CHECK_FALSE(replay.is_other_scenario);
    CHECK(replay_inputs(part, {}).now == replay.now);
    for (const std::string& path : {out, part}) {
        const Ended ended = command(folder, {"replay", path, "--verify"});
        CHECK(ended.exit == 0);
        CHECK(ended.out.find("9 inputs") != std::string::npos);
        CHECK(ended.err.find("did not end") != std::string::npos);
    }
    CHECK(command(folder, {"run", out + "/scenario.toml", "--print-scenario"}).exit == 0);
}

TEST_CASE("killed run: an incomplete last line of the input log is ignored, with a notice") {
    const TemporaryFolder folder;
    const std::string part = run_and_kill(folder, folder.path("out"), "1", 3);
    const std::string text = content(part);
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    for (std::size_t end = last; end < text.size(); ++end) {
        CAPTURE(end - last);
        std::ofstream(part, std::ios::binary) << text.substr(0, end);
        const InputReplay replay = replay_inputs(part, {});
        const bool is_whole = end == text.size() - 1;  // but for its end of line
        CHECK(replay.inputs == (is_whole ? 3 : 2));
        CHECK(replay.torn.has_value() == (end > last && !is_whole));
        if (replay.torn) CHECK(*replay.torn == 4);
    }
    std::ofstream(part, std::ios::binary) << text.substr(0, last + 20);
    CHECK(command(folder, {"replay", part, "--verify"}).err.find(part + ":4: ") !=
          std::string::npos);
    // In its midst it is no torn line, but a broken file.
    std::ofstream(part, std::ios::binary) << text.substr(0, last + 20) << '\n' << text.substr(last);
    CHECK_THROWS_WITH_AS(replay_inputs(part, {}), doctest::Contains(".part:4"), InputError);
}

TEST_CASE("killed run: later runs into the same folder keep the killed run's input log") {
    const TemporaryFolder folder, words;
    const std::string out = folder.path("out");
    const std::string first = run_and_kill(words, out, "1", 3);
    const std::string before = replay_inputs(first, {}).now;
    const std::string second = run_and_kill(words, out, "2", 5);
    const std::string after = replay_inputs(second, {}).now;
    CHECK(before != after);
    CHECK(replay_inputs(out, {}).log == second);  // the newest
    CHECK(replay_inputs(out, {}).others == std::vector<std::string>{first});

    const std::string file = folder.write("s.toml", live_row);
    CHECK(command(words, {"run", file, "--out", out, "--seed", "3"}).exit == 0);
    const TemporaryFolder more_words;
    const std::string third = run_and_kill(more_words, out, "4", 2);
    // The results are those of the last run that ended, with its scenario.
    CHECK(content(out + "/scenario.toml").find("seed = 3") != std::string::npos);
    {
        const Process process(
            words, {"emulate", file, "--udp", "127.0.0.1:0", "--out", out, "--late", "60 s"});
        said(words, "listening on ");
        process.interrupt();
        CHECK(process.wait().exit == 0);
    }
    CHECK(fs::exists(out + "/inputs.jsonl"));
    CHECK(replay_inputs(out, {}).log == out + "/inputs.jsonl");
    CHECK(parts_in(out).size() == 3);
    CHECK(replay_inputs(first, {}).now == before);
    CHECK(replay_inputs(first, {}).has_own_scenario);
    CHECK(replay_inputs(second, {}).now == after);
    CHECK(replay_inputs(third, {}).inputs == 2);
    CHECK(command(words, {"replay", out, "--verify"}).err.find(first) != std::string::npos);
}

TEST_CASE("killed run: a killed emulation can be replayed, too") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const std::string file = folder.write("s.toml", long_live_row());
    {
        const Process process(folder, {"emulate", file, "--udp", "127.0.0.1:0", "--player",
                                       "127.0.0.1:0", "--out", out, "--late", "60 s"});
        LineClient client(read_port(said(folder, "listening on ", "(Player, robot A)")));
        open_position(client);
        client.send_bytes(rovernet::test::drive(1, 0));
        const std::string part = out + "/inputs.jsonl." + std::to_string(process.pid()) + ".part";
        for (int i = 0; i < 1000 && lines_in(part) < 2; ++i) std::this_thread::sleep_for(10ms);
        kill(process.pid(), SIGKILL);
        process.wait();
    }
    CHECK(fs::exists(out + "/scenario.toml"));
    CHECK(replay_inputs(out, {}).inputs == 1);
}

TEST_CASE("killed run: the input log of a failed run has only the inputs after the last reset") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const std::string limited = [] {
        std::string text = long_live_row();
        return text.insert(text.find("duration"), "event_limit = 60\n");
    }();
    const std::string file = folder.write("s.toml", limited);
    const Process process(folder, {"live", file, "--listen-json", "127.0.0.1:0", "--out", out});
    LineClient client(read_port(said(folder, "listening on ")));
    client.ask(hello("\"A\"", "1 s"));
    client.ask(R"({"type":"step","n":1,"do":{"A":{"v":1}}})");
    client.ask(R"({"type":"reset"})");
    CHECK(parts_in(out).size() == 1);
    for (int n = 1; n <= 1000; ++n) {
        if (client.ask(R"({"type":"step","n":)" + std::to_string(n) + R"(,"do":{"A":{"v":2}}})")
                .empty()) {
            break;
        }
    }
    CHECK(process.wait().exit == 1);
    REQUIRE(parts_in(out).size() == 1);
    CHECK(content(parts_in(out)[0]).find(R"("v":2.0)") != std::string::npos);
    CHECK(content(parts_in(out)[0]).find(R"("v":1.0)") == std::string::npos);
}

}  // namespace killed_run_test
