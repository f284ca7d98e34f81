// SPDX-License-Identifier: MIT
// The command `emulate --udp`, with plain sockets as programs.
#include "test/live/emulate/datagrams.hpp"
#include "test/live/emulate/emulation.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace udp_test {
using namespace rovernet::test;
using namespace std::chrono_literals;
using namespace std::string_literals;

namespace {

/// A and B hear one another; C is out of range of A. A fifth of what D sends is lost.
const std::string scenario = R"([scenario]
name = "relay"
duration = "60 s"
[propagation]
model = "friis"
[radio]
sensitivity = "-70 dBm"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["150 m", "0 m"]
[[robot]]
name = "C"
at = ["300 m", "0 m"]
[[robot]]
name = "D"
at = ["0 m", "10 m"]
radio = { success_rate = 0.8 }
)";

const std::string to_all = "RN\x01\x00\xff\xff\xff\xff"s;
const std::string to_b = "RN\x01\x00\x01\x00\x00\x00"s;

}  // namespace

TEST_CASE(
    "emulate --udp: programs reach robots in range, and the run is replayed without the programs") {
    Emulation emulation(scenario, {"--udp", "127.0.0.1:0", "--late", "60 s"});
    const std::vector<int> ports = emulation.ports(4);
    const Datagrams a(ports[0]), b(ports[1]), c(ports[2]);
    b.send("who I am");  // the port answers to whoever has spoken last
    c.send("who I am");
    for (int i = 0; i < 20; ++i) {
        const std::string words = "question " + std::to_string(i);
        a.send((i % 2 == 0 ? to_all : to_b) + words);
        const std::string question = b.next(20s);
        REQUIRE(question.size() > 12);
        CHECK(question.substr(0, 8) == "RN\x01\x01\x00\x00\x00\x00"s);
        CHECK(question.substr(12) == words);
        b.send(to_all + "answer");
        const std::string answer = a.next(20s);
        REQUIRE(answer.size() > 12);
        CHECK(answer.substr(12) == "answer");
        CHECK(c.next(20s).substr(12) == "answer");  // what B says, and nothing from A
    }
    const Ended ended = emulation.stop();
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("\nlate  ") != std::string::npos);
    const Json live = emulation.summary().at("live");
    CHECK(live.at("packets_sent") == 42);
    CHECK(live.at("packets_received") >= 89);  // D hears them, too; the last one after the end
    CHECK(live.at("malformed") == 2);
    CHECK(live.at("late_max_s") > 0);
    CHECK(live.at("late_share") <= 1);
    const std::string fingerprint = emulation.summary().at("fingerprint");
    CHECK(emulation.replay().out == "identical: 40 inputs, fingerprint " + fingerprint + "\n");
}

TEST_CASE("emulate --udp: a radio with success_rate 0.8 loses a fifth of the datagrams") {
    Emulation emulation(scenario, {"--udp", "127.0.0.1:0", "--late", "60 s"});
    const std::vector<int> ports = emulation.ports(4);
    const Datagrams a(ports[0]), d(ports[3]);
    a.send("");
    const std::string no_text = to_all + '\x01';
    constexpr int trials = 400;
    int received = 0;
    for (int i = 0; i < trials; ++i) {
        d.send(no_text);
        if (!a.next(1ms).empty()) ++received;
    }
    while (!a.next(2s).empty()) ++received;
    CHECK(emulation.stop().exit == 0);
    CHECK(emulation.summary().at("timeline").empty());
    const double sigma = std::sqrt(trials * 0.8 * 0.2);
    CHECK(std::abs(received - 0.8 * trials) <= 4 * sigma);
    CHECK(received < trials);
    CHECK(emulation.replay().exit == 0);
}

TEST_CASE("emulate: a run behind real time gives one warning, or fails with --on-late fail") {
    const std::string talks =
        scenario + "[[traffic]]\nfrom = \"A\"\nsize = \"10 B\"\nevery = \"10 ms\"\n";
    Emulation warns(talks, {"--udp", "127.0.0.1:0", "--late", "1 ns", "--speed", "100"});
    const Ended warned = warns.wait();
    CHECK(warned.exit == 0);
    const std::size_t first = warned.err.find("ms behind real time at");
    CHECK(first != std::string::npos);
    CHECK(warned.err.find("ms behind", first + 1) == std::string::npos);
    CHECK(warns.summary().at("sim_s") == 60);

    Emulation fails(talks, {"--udp", "127.0.0.1:0", "--late", "1 ns", "--on-late", "fail"});
    const Ended failed = fails.wait();
    CHECK(failed.exit == 1);
    CHECK(failed.err.find("ms behind real time at") != std::string::npos);
    CHECK(fails.summary().at("sim_s") < 1);
    CHECK(fails.replay().exit == 0);
}

TEST_CASE(
    "emulate: a run whose process was stopped while idle is late, and fails with --on-late fail") {
    for (const std::string on_late : {"warn", "fail"}) {
        CAPTURE(on_late);
        Emulation run(scenario, {"--udp", "127.0.0.1:0", "--late", "300ms", "--on-late", on_late});
        const std::vector<int> ports = run.ports(4);
        const Datagrams a(ports[0]), b(ports[1]);
        b.send("who I am");
        a.send(to_b + "the clock goes");
        CHECK_FALSE(b.next(20s).empty());
        constexpr auto stopped_for = 700ms;
        kill(run.pid(), SIGSTOP);
        std::this_thread::sleep_for(stopped_for);
        kill(run.pid(), SIGCONT);
        const bool fails = on_late == "fail";
        if (!fails) {  // it goes on, and has seen that it is late once it serves again
            a.send(to_b + "it goes on");
            CHECK_FALSE(b.next(20s).empty());
        }
        const Ended ended = fails ? run.wait() : run.stop();
        CHECK(ended.exit == (fails ? 1 : 0));
        CHECK(ended.err.find("ms behind real time at") != std::string::npos);
        if (!fails) CHECK(run.summary().at("live").at("late_max_s") > 0.6);
    }
}

TEST_CASE("emulate --udp: only this machine can connect, and a port in use is reported") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", scenario);
    const auto emulate = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"emulate", file, "--out", folder.path("out")});
        return command(folder, options);
    };
    CHECK(emulate({"--udp", "0.0.0.0:7100"}).exit == 2);
    const Ended narrow = emulate({"--udp", "127.0.0.1:65534"});
    CHECK(narrow.exit == 2);
    CHECK(narrow.err.find("expected 2 robots at most") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder.path("out")));  // nothing is begun
    CHECK(emulate({"--udp", "127.0.0.1:0", "--late", "-1s"}).exit != 0);
    CHECK(emulate({"--udp", "127.0.0.1:0", "--on-late", "wait"}).exit == 2);
    Emulation first(scenario, {"--udp", "127.0.0.1:0"});
    const Ended second = emulate({"--udp", "127.0.0.1:" + std::to_string(first.ports(4)[0])});
    CHECK(second.exit == 1);
    CHECK(second.err.find("(robot A): Address already in use") != std::string::npos);
}

}  // namespace udp_test
