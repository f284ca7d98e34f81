// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_day.hpp"

#include "experiment/run.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "sim/sink.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

namespace recorded_day_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// Robots that move, go to meet whoever calls, answer, and are switched off and on.
const char* const busy_day = R"([scenario]
name = "busy"
duration = "20 s"
[radio]
power = "-10 dBm"
[[robot]]
name = "r"
count = 6
place = { model = "uniform", area = [["0 m", "0 m"], ["80 m", "80 m"]] }
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["80 m", "80 m"]], min_speed = "1 m/s", max_speed = "5 m/s" }
[[robot]]
name = "A"
at = ["10 m", "10 m"]
off = ["6 s"]
on = ["9 s"]
move = { model = "waypoints", path = [["70 m", "70 m"]], speed = "4 m/s" }
turn_rate = "90 deg/s"
[[robot]]
name = "B"
at = ["30 m", "10 m"]
on_receive = { payload = "F", once = true, send = "coming", move = { model = "waypoints", path = [["10 m", "60 m"]], speed = "3 m/s" } }
[[traffic]]
from = "A"
payload = "F"
every = "700 ms"
[[traffic]]
from = "random"
kind = "unicast"
to = "A"
size = "300 B"
every = "300 ms"
)";

std::string record(const TemporaryFolder& folder, const std::string& scenario) {
    const std::string file = folder.write("day.toml", scenario);
    run_scenario(load_scenario(file, {.set = {"trace.record=true"}}),
                 {.folder = folder.path("run"), .speed = {}});
    return folder.path("run") + "/trace.mcap";
}

}  // namespace

TEST_CASE(
    "replay of a recorded trace: the recorded radio gives the recorded metrics to the last digit") {
    for (const std::string more :
         {"", "[reception]\nmodel = \"sinr\"\n[access]\nmodel = \"csma\"\n",
          "[study]\nwarmup = \"5 s\"\n"}) {
        CAPTURE(more);
        const TemporaryFolder folder;
        const RecordedDay day(record(folder, busy_day + more));
        CHECK(day.notices().empty());
        const PlayedDay again = day.play({});
        CHECK(again.metrics == day.recorded().metrics);
        CHECK(again.metrics.deliveries > 20);
        const DeliveryChange change = change_of(day.recorded(), again, day.robots().size());
        CHECK(change.all_gained() == 0);
        CHECK(change.all_lost() == 0);
    }
}

TEST_CASE(
    "replay of a recorded trace: a weaker radio loses deliveries; the recorded power gives the "
    "recorded metrics") {
    const TemporaryFolder folder;
    const RecordedDay day(record(folder, busy_day));
    const PlayedDay weak = day.play({"radio.power=-30 dBm"});
    const DeliveryChange change = change_of(day.recorded(), weak, day.robots().size());
    CHECK(change.all_lost() > 0);
    CHECK(day.recorded().deliveries.size() + change.all_gained() - change.all_lost() ==
          weak.deliveries.size());
    CHECK(weak.metrics.messages == day.recorded().metrics.messages);
    const PlayedDay back = day.play({"radio.power=-10 dBm"});
    CHECK(back.metrics == day.recorded().metrics);
}

TEST_CASE("replay of a recorded trace: the error for an unknown setting names this setting") {
    const TemporaryFolder folder;
    const RecordedDay day(record(folder, busy_day));
    CHECK_THROWS_WITH_AS(day.play({"propagation.modle=friis"}), doctest::Contains("modle"),
                         InputError);
}

TEST_CASE("replay of a recorded trace: robots keep their roles in the routing protocol") {
    std::string scenario =
        "[scenario]\nduration = \"9 s\"\n[propagation]\nmodel = \"disc\"\nrange = \"9 m\"\n"
        "[routing]\nprotocol = \"managed\"\n"
        "[[traffic]]\nfrom = \"r0\"\npayload = \"F\"\nevery = \"1 s\"\n";
    for (int i = 0; i < 4; ++i) {
        scenario += "[[robot]]\nname = \"r" + std::to_string(i) + "\"\nat = [\"" +
                    std::to_string(8 * i) + " m\", \"0 m\"]\n" +
                    (i == 2 ? "role = \"mute\"\n" : "");
    }
    const TemporaryFolder folder;
    const RecordedDay day(record(folder, scenario));
    CHECK(day.play({}).metrics == day.recorded().metrics);
    CHECK(day.recorded().metrics.deliveries > 0);
}

TEST_CASE(
    "replay of a recorded trace: a robot without recorded movements stands where the scenario puts "
    "it") {
    const TemporaryFolder folder;
    RecordedReader trace(record(folder, busy_day));
    RecordedRun run = trace.run();
    DayLog log;
    trace.read(Sink(DayLogSink{log}));
    const std::size_t robot_b = 7;
    REQUIRE(run.robots[robot_b] == "B");
    log.legs[robot_b].clear();
    log.heard.push_back({start_of_run, NodeId{6}, NodeId{robot_b}});
    const RecordedDay day(run, folder.path("run") + "/trace.mcap", log);
    CHECK(day.hears_farther({"radio.power=-90 dBm"}).empty());
    const PlayedDay again = day.play({});
    CHECK(std::any_of(again.deliveries.begin(), again.deliveries.end(),
                      [](const Delivery& each) { return each.at == NodeId{robot_b}; }));
}

}  // namespace recorded_day_test
