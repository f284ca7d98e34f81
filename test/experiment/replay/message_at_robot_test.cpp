// SPDX-License-Identifier: MIT
#include "experiment/replay/message_at_robot.hpp"

#include "experiment/reports/link_report.hpp"
#include "experiment/run.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/recorded/recorded_index.hpp"
#include "traces/recorded/recorded_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace message_at_robot_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// A run that is recorded: robots A, B, C ... on a line, at these x [m].
struct Run {
    TempFolder folder;
    std::string recorded = folder / "trace.mcap";

    Run(const std::vector<double>& places, const std::string& more) {
        std::string text = "[scenario]\nduration = \"5 s\"\n[routing]\nprotocol = \"flood\"\n";
        char name = 'A';
        for (const double x : places) {
            text += std::string("[[robot]]\nname = \"") + name++ + "\"\nat = [\"" +
                    std::to_string(x) + " m\", \"0 m\"]\n";
        }
        write_file(folder / "s.toml", text + more);
        record(folder / "s.toml", {});
    }
    explicit Run(const std::string& file) { record(file, "scenario.duration=30 s"); }

    MessageAtRobot look(std::uint64_t uid, std::uint32_t robot) const {
        return message_at_robot(recorded, uid, NodeId{robot});
    }
    std::string says(std::uint64_t uid, std::uint32_t robot) const {
        return sentence(look(uid, robot));
    }

  private:
    void record(const std::string& file, const std::string& set) {
        std::vector<std::string> all{"trace.record=true"};
        if (!set.empty()) all.push_back(set);
        RunOptions to;
        to.folder = folder / ".";
        run_scenario(load_scenario(file, {.set = all}), to);
    }
};

const std::string one_message = "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\nstart = \"1 s\"\n";

}  // namespace

TEST_CASE(
    "message at a robot: for a signal that was too weak, level and margin equal the free-space "
    "values") {
    const Run run({0, 1000}, one_message);
    const MessageAtRobot there = run.look(0, 1);
    REQUIRE(there.frames.size() == 1);
    const FrameAtRobot& frame = there.frames[0];
    const double wavelength = 299'792'458 / 2450e6;
    const double loss = 20 * std::log10(4 * 3.141592653589793 * 1000 / wavelength);
    CHECK(std::abs(frame.level.value - (10 * std::log10(45.0) - loss)) < 1e-9);
    CHECK(std::abs(frame.margin.value - (frame.level.value + 75)) < 1e-9);
    CHECK(frame.outcome == Outcome::too_weak);
    CHECK(frame.others.empty());
    CHECK(
        sentence(there) ==
        "B was never in range: the only frame came 8.7 dB below the sensitivity of the receiver.");
}

TEST_CASE("message at a robot: a received message is described by sender, time and level") {
    const Run run({0, 100, 400}, one_message);
    CHECK(run.says(0, 0) == "A is the origin of the message.");
    CHECK(run.says(0, 1).starts_with(
        "B received the message from A, 0.193 ms after the message was sent: the frame came at "
        "-63.70 dBm, 11.3 dB above the sensitivity of the receiver."));
    const MessageAtRobot there = run.look(0, 2);
    REQUIRE(there.frames.size() >= 2);
    CHECK(there.frames[0].outcome == Outcome::too_weak);  // A's, over 400 m
    CHECK(there.frames[1].outcome == Outcome::received);
    CHECK(sentence(there).starts_with("C received the message from B"));
    const MessageAtRobot back = run.look(0, 0);
    REQUIRE_FALSE(back.frames.empty());
    CHECK(back.frames[0].outcome == Outcome::duplicate);
}

TEST_CASE(
    "message at a robot: a message can be missed because the robot was off or in another network") {
    const Run off({0, 100}, one_message +
                                "[[robot]]\nname = \"X\"\nat = [\"50 m\", \"0 m\"]\n"
                                "off = [\"0.5 s\"]\n");
    CHECK(off.look(0, 2).frames.at(0).outcome == Outcome::off);
    CHECK(off.says(0, 2) == "X was switched off, and could receive none of 2 frames.");
    const Run gated({0, 100}, one_message +
                                  "[[robot]]\nname = \"X\"\nat = [\"50 m\", \"0 m\"]\n"
                                  "radio = { channel = 7 }\n");
    CHECK(gated.look(0, 2).frames.at(0).outcome == Outcome::other_network);
    CHECK(gated.says(0, 2).starts_with("X is in a different network"));
}

TEST_CASE(
    "message at a robot: for a collision, the other frames on air are listed with their levels") {
    // A and C send at once, and B, in their middle, hears both alike.
    const Run run({0, 200, 400},
                  "[reception]\nmodel = \"collision\"\n" + one_message +
                      "[[traffic]]\nfrom = \"C\"\npayload = \"y\"\nstart = \"1 s\"\n");
    const MessageAtRobot there = run.look(0, 1);
    REQUIRE(there.frames.size() == 1);
    const FrameAtRobot& frame = there.frames[0];
    CHECK(frame.outcome == Outcome::collided);
    REQUIRE(frame.others.size() == 1);
    CHECK(frame.others[0].from == NodeId{2});
    CHECK(std::abs((frame.others[0].level - frame.level).value) < 1e-9);
    CHECK(sentence(there) ==
          "B was in range of 1 of 1 frame, but lost it: while other frames were on air.");
    CHECK(run.says(1, 1) == sentence(there));
}

TEST_CASE("message at a robot: the reason for a loss may be that the receiver was sending") {
    const Run run({0, 200}, "[reception]\nmodel = \"collision\"\n" + one_message +
                                "[[traffic]]\nfrom = \"B\"\npayload = \"y\"\nstart = \"1 s\"\n");
    const MessageAtRobot there = run.look(0, 1);
    REQUIRE(there.frames.size() == 1);
    CHECK(there.frames[0].outcome == Outcome::busy);
    REQUIRE(there.frames[0].others.size() == 1);
    CHECK(there.frames[0].others[0].from == NodeId{1});
    CHECK(there.frames[0].others[0].level.value == std::numeric_limits<double>::infinity());
    CHECK(sentence(there) ==
          "B was in range of 1 of 1 frame, but lost it: while the robot itself was sending.");
}

TEST_CASE(
    "message at a robot: each attempt of a unicast is listed; at other robots it is marked as sent "
    "to another robot") {
    const Run run({0, 100, 200},
                  "[access]\nmodel = \"csma\"\n[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = "
                  "\"B\"\npayload = \"x\"\nstart = \"1 s\"\n"
                  "[[traffic]]\nkind = \"unicast\"\nfrom = \"C\"\nto = \"D\"\npayload = \"x\"\n"
                  "start = \"2 s\"\n"
                  "[[robot]]\nname = \"D\"\nat = [\"5000 m\", \"0 m\"]\n");
    CHECK(run.look(0, 1).frames.at(0).outcome == Outcome::received);
    CHECK(run.look(0, 2).frames.at(0).outcome == Outcome::for_another);
    CHECK(run.says(0, 2) == "C was not on the way of the message, which is for B.");
    const MessageAtRobot far = run.look(1, 3);
    CHECK(far.frames.size() == 7);  // the attempts at a short frame
    CHECK(run.says(1, 3).starts_with("D was never in range: the strongest of 7 frames"));
}

TEST_CASE(
    "message at a robot: in the example `rescue`, levels and walls equal those of `rovernet "
    "link`") {
    const std::string file = ROVERNET_EXAMPLES "/rescue/rescue.toml";
    const Run run(file);
    const Scenario scenario = load_scenario(file, {});
    std::size_t looked = 0, behind_walls = 0;
    for (std::uint64_t uid = 0; uid < 3; ++uid) {
        const MessageAtRobot there = run.look(uid, 4);
        for (const FrameAtRobot& frame : there.frames) {
            const LinkReport link =
                report_link(scenario, there.names[frame.from.index()], "E", frame.begin);
            CHECK(std::abs((link.received - frame.level).value) < 1e-9);
            CHECK(std::abs((link.margin - frame.margin).value) < 1e-9);
            CHECK(link.walls.size() == frame.walls);
            CHECK(std::abs(link.wall_m - frame.wall_m) < 1e-9);
            CHECK(link.up == (frame.outcome != Outcome::too_weak));
            ++looked;
            if (frame.walls > 0) ++behind_walls;
        }
    }
    CHECK(looked >= 6);
    CHECK(behind_walls > 0);
    // Message 0 reaches E, so that the sentence names a way; walls are counted in it.
    CHECK(run.says(0, 4).find("wall") != std::string::npos);
}

TEST_CASE("message at a robot: an index of the trace does not change the answer") {
    // Robots walk and switch off; their frames overlap, and waiting makes messages long.
    const Run run({0, 100, 200, 300}, R"([access]
model = "csma"
[reception]
model = "collision"
[[robot]]
name = "w"
count = 8
off = ["1 s", "3 s"]
on = ["2 s"]
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["300 m", "300 m"]], min_speed = "5 m/s", max_speed = "20 m/s" }
[[traffic]]
from = "A"
size = "500 B"
every = "10 ms"
[[traffic]]
from = "w3"
size = "1500 B"
start = "1 ms"
every = "25 ms"
)");
    const std::string path = run.folder / "chunks.mcap";
    RecordedReader whole(run.recorded);
    const auto trace = std::make_shared<RecordedTrace>(
        path,
        RecordedTrace::Contents{.version = "1", .scenario = whole.run().scenario, .chunk = 600});
    whole.read(Sink(trace));
    trace->close();
    RecordedReader reader(path);
    RecordedIndex index;
    std::uint64_t records = 0;
    for (; const Record* record = reader.next(); ++records)
        index.add(reader.chunk(), *record, reader.context());
    CHECK(reader.chunk() > 50);
    std::uint64_t read = 0, overlaps = 0;
    constexpr std::uint64_t step = 7, messages = 600;
    for (std::uint64_t uid = 0; uid < messages; uid += step) {
        for (const auto& range : index.chunks_of(uid)) read += range.records;
        for (const std::uint32_t robot : {1U, 3U, 5U, 11U}) {
            const MessageAtRobot there = message_at_robot(path, uid, NodeId{robot}, &index);
            const MessageAtRobot by_all = run.look(uid, robot);
            CHECK(to_json_line(document_of(there)) == to_json_line(document_of(by_all)));
            for (const FrameAtRobot& frame : there.frames) overlaps += frame.others.size();
        }
    }
    CHECK(overlaps > 100);
    CHECK(read / (messages / step) < records / 10);
}

TEST_CASE("message at a robot: a routed unicast that was dropped on its way names where and why") {
    const TempFolder folder;
    const auto line_of_three = [&](const std::string& keys, const std::string& of_c) {
        const std::string file = folder / "routed.toml";
        write_file(file,
                   "[propagation]\nmodel = \"disc\"\nrange = \"250 m\"\n[access]\nmodel = "
                   "\"csma\"\n[routing]\nprotocol = \"aodv\"\n" +
                       keys +
                       "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
                       "[[robot]]\nname = \"B\"\nat = [\"200 m\", \"0 m\"]\n"
                       "[[robot]]\nname = \"C\"\nat = [\"400 m\", \"0 m\"]\n" +
                       of_c +
                       "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = \"C\"\n"
                       "size = \"64 B\"\nstart = \"1 s\"\nevery = \"30 s\"\n");
        return Run(file);
    };
    const Run alone = line_of_three("", "off = [\"0.5 s\"]\n");
    const std::string no_route = alone.says(0, 2);
    CHECK(
        no_route.starts_with("No robot sent the message to C: A dropped it, because it had no "
                             "route (NRTE), "));
    CHECK(alone.says(0, 1) == "B was not on the way of the message, which is for C.");
    CHECK(alone.says(0, 0) == "A is the origin of the message.");
    const Run short_lived = line_of_three("ttl = 1\n", "");
    CHECK(short_lived.says(0, 2).starts_with(
        "No robot sent the message to C: B dropped it, because its TTL was used up (TTL), "));
    CHECK(line_of_three("", "").says(0, 2).starts_with("C received the message from B, "));
}

TEST_CASE(
    "message at a robot: a trace of a network built in code, and an unknown robot, are refused") {
    const TempFolder folder;
    RecordedTrace trace(folder / "t.mcap", {.version = "1"});
    trace.begin({.scenario = {},
                 .robots = 1,
                 .name = [](NodeId) -> std::string_view { return "r"; },
                 .seed = 1,
                 .replication = 0});
    trace.finish();
    trace.close();
    CHECK_THROWS_AS(message_at_robot(folder / "t.mcap", 0, NodeId{0}), InputError);
    const Run run({0, 100}, one_message);
    CHECK_THROWS_AS(run.look(0, 7), InputError);
}

}  // namespace message_at_robot_test
