// SPDX-License-Identifier: MIT
// Signals to runs that serve programs: while a network is set up, and with controllers that will
// not end.
#include "test/live/live_command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace stopping_test {
using namespace rovernet::test;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

/// Robots whose ways take long to plan, before the first of them moves.
const std::string long_to_set_up = R"([scene]
map = ")" ROVERNET_EXAMPLES R"(/rescue/map.yaml"
[[robot]]
name = "r"
count = 20000
move = { model = "random_waypoint", area = [["4 m", "4 m"], ["44 m", "22 m"]] }
)";

/// A program that says its number and will not end by a signal that it can ignore.
const std::string stubborn = R"(import os, signal, sys, time
signal.signal(signal.SIGTERM, signal.SIG_IGN)
signal.signal(signal.SIGHUP, signal.SIG_IGN)
with open(sys.argv[1] + ".new", "w") as file:
    print(os.getpid(), file=file)
os.rename(sys.argv[1] + ".new", sys.argv[1])
time.sleep(600)
)";

/// Number that a program has written into a file; waits for it.
pid_t number_in(const std::string& path) {
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(10ms)) {
        std::ifstream file(path);
        pid_t number = 0;
        if (file >> number) return number;
    }
    FAIL("nobody writes " << path);
    return -1;
}

/// Whether a process runs: one that has ended may be there until its new parent looks.
bool runs(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(file, text);
    const std::size_t name_end = text.rfind(')');
    return name_end != std::string::npos && text.at(name_end + 2) != 'Z';
}

/// Whether it ends within 20 s; else it is killed.
bool ends(pid_t pid) {
    for (int i = 0; i < 2000 && runs(pid); ++i) std::this_thread::sleep_for(10ms);
    if (!runs(pid)) return true;
    kill(pid, SIGKILL);
    return false;
}

const int stop_signals[] = {SIGINT, SIGTERM, SIGHUP};

}  // namespace

TEST_CASE(
    "stopping: each signal immediately ends the set-up of a network, and leaves nothing behind") {
    for (const int signal : stop_signals) {
        CAPTURE(signal);
        const Live live({"--unix", "SOCKET", "--controller", "PROGRAM PIDFILE"}, long_to_set_up,
                        stubborn);
        const pid_t program = number_in(live.folder.path("pid"));
        live.said("listening on ");
        kill(live.process().pid(), signal);
        CHECK(live.wait().exit == 130);
        CHECK(ends(program));
        CHECK_FALSE(fs::exists(live.folder.path("socket")));
        CHECK_FALSE(fs::exists(live.folder.path("out/summary.json")));
    }
}

TEST_CASE(
    "stopping: a signal during the set-up of an emulation or a paced run ends it immediately") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", long_to_set_up);
    const std::vector<std::vector<std::string>> commands = {
        {"emulate", file, "--udp", "127.0.0.1:0", "--out", folder.path("out")},
        {"live", file, "--rosbridge", "127.0.0.1:0", "--out", folder.path("out")}};
    for (const auto& words : commands) {
        for (const int signal : stop_signals) {
            CAPTURE(words[0]);
            CAPTURE(signal);
            const Process process(folder, words);
            // Addresses are told in one go; emulate tells none before it has its network.
            if (words[0] == "live") said(folder, "listening on ");
            std::this_thread::sleep_for(500ms);
            kill(process.pid(), signal);
            CHECK(process.wait().exit == 130);
            CHECK_FALSE(fs::exists(folder.path("out/summary.json")));
        }
    }
}

TEST_CASE("stopping: a controller is ended with all its children, whatever signals they ignore") {
    struct Row {
        const char* what;
        const char* command;
    };
    const Row rows[] = {
        {"the program alone", "exec PROGRAM PIDFILE"},
        {"below a shell", "PROGRAM PIDFILE; true"},
        {"below a shell that waits", "PROGRAM PIDFILE & wait"},
        {"the shell has gone first", "PROGRAM PIDFILE & exit 0"},
        {"the shell ignores it, too", "trap '' TERM; PROGRAM PIDFILE & wait; sleep 600"},
        {"with its input and output closed", "PROGRAM PIDFILE < /dev/null > /dev/null & exit 0"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.what);
        const Live live({"--controller", row.command, "--listen-json", "127.0.0.1:0"}, live_row,
                        stubborn);
        const pid_t program = number_in(live.folder.path("pid"));
        live.said("listening on ");
        live.process().interrupt();
        CHECK(live.wait().exit == 0);
        CHECK(ends(program));
    }
}

TEST_CASE("stopping: a run that ends also ends programs that its controllers have started") {
    // It speaks once the program ignores signals.
    const std::string talk =
        R"(while ! test -e PIDFILE; do sleep 0.01; done; )"
        R"((printf '%s\n' '{"type":"hello","protocol":1,"robots":["A"],"step":"1 s"}'; read a; )"
        R"(printf '%s\n' '{"type":"bye"}'; read a) )";
    const Live live({"--controller", "PROGRAM PIDFILE > /dev/null & " + talk}, live_row, stubborn);
    const pid_t program = number_in(live.folder.path("pid"));
    CHECK(live.wait().exit == 0);
    CHECK(ends(program));
}

TEST_CASE("stopping: SIGHUP ends a run as SIGTERM does, unless SIGHUP is ignored") {
    for (const int signal : {SIGTERM, SIGHUP}) {
        CAPTURE(signal);
        const Live live({"--listen-json", "127.0.0.1:0"}, long_live_row());
        LineClient client(live.port());
        CHECK_FALSE(client.ask(hello("\"A\"")).empty());
        CHECK_FALSE(client.ask(R"({"type":"step","n":1,"do":{"A":{"v":1}}})").empty());
        kill(live.process().pid(), signal);
        CHECK(live.wait().exit == 0);
        CHECK(live.replay().out == "identical: 1 inputs, fingerprint " + live.fingerprint() + "\n");
    }
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", long_live_row());
    const Process process(folder,
                          {"-c", "trap '' HUP; exec \"$0\" \"$@\"", ROVERNET_COMMAND, "live", file,
                           "--listen-json", "127.0.0.1:0", "--out", folder.path("out")},
                          "/bin/sh");
    LineClient client(read_port(said(folder, "listening on ")));
    CHECK_FALSE(client.ask(hello("\"A\"")).empty());
    kill(process.pid(), SIGHUP);
    for (int n = 1; n <= 20; ++n, std::this_thread::sleep_for(20ms)) {
        CHECK_FALSE(client.ask(R"({"type":"step","n":)" + std::to_string(n) + "}").empty());
    }
    process.interrupt();
    CHECK(process.wait().exit == 0);
}

}  // namespace stopping_test
