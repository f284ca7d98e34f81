// SPDX-License-Identifier: MIT
#include "experiment/replay/ns2_day.hpp"

#include "experiment/movement_play.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/ns2/ns2_file.hpp"
#include "traces/ns2/ns2_motion.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

namespace ns2_day_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

const std::string sample = std::string(ROVERNET_TEST_DATA) + "/ns2_old.tr";

std::string move_line(int robot, double x) {
    return fmt::format("M 0.00000 {} ({:.2f}, 0.00, 0.00), ({:.2f}, 0.00), 0.00\n", robot, x, x);
}

/// `s AGT` of a message, number `id` of robot `from`.
std::string said(double time, int id, int from, const std::string& to) {
    return fmt::format(
        "s {:.9f} _{}_ AGT  --- {} cbr 64 [0 0 0 0] ------- [{}:0 {}:0 32 0] [0] 0 0\n", time, from,
        id, from, to);
}

std::uint64_t deliveries(const RecordedDay& day, const std::vector<std::string>& set = {}) {
    return day.play(set).metrics.deliveries;
}

/// Motion that a movement file makes, asked for later and later times.
class Truth {
  public:
    explicit Truth(const std::string& path) {
        MovementFile file(path);
        std::vector<NodeId> nodes;
        for (const FileRobot& robot : file.robots()) {
            nodes.push_back(network_.add({.name = robot.name, .at = robot.start}));
        }
        rovernet::play(network_, std::move(file), nodes);
    }
    std::size_t size() const { return network_.size(); }
    Vec3 place(NodeId node, Time t) {
        if (t > network_.now()) network_.run_until(t);
        return network_.position(node);
    }

  private:
    Network network_;
};

struct Place {
    NodeId node;
    Time time;
};

/// What a trace tells of the places of ten robots.
struct Told {
    std::vector<std::vector<Leg>> legs;
    std::vector<Place> lines;  ///< packet lines with a place
};

Told told_by(const std::string& trace) {
    Told told;
    Ns2Motion motion;
    Ns2File file(trace);
    while (const Ns2Line* line = file.next()) {
        if (const auto* move = std::get_if<Ns2Move>(line)) {
            motion.begins(move->node, leg_of(*move));
        } else if (const auto* packet = std::get_if<Ns2Packet>(line); packet && packet->position) {
            motion.is_at(packet->node, packet->time, *packet->position);
            told.lines.push_back({packet->node, packet->time});
        }
    }
    for (NodeId n{0}; n.value < 10; ++n.value) told.legs.push_back(motion.legs(n));
    return told;
}

Vec3 place_on(const std::vector<Leg>& legs, Time t) {
    const auto next = std::upper_bound(legs.begin(), legs.end(), t,
                                       [](Time time, const Leg& leg) { return time < leg.start; });
    return std::prev(next)->position(t);
}

/// Files of ns-2 and the motion that made them; false if they are not there.
bool find_pair(std::string& traces, std::string& movements) {
    const char* a = std::getenv("ROVERNET_TRACES");
    const char* b = std::getenv("ROVERNET_MOVEMENTS");
    if (!a || !b) {
        MESSAGE("skipped: ROVERNET_TRACES or ROVERNET_MOVEMENTS is not set");
        return false;
    }
    traces = std::string(a) + "/";
    movements = std::string(b) + "/mob10.tcl";
    return true;
}

}  // namespace

TEST_CASE(
    "replay of an ns-2 trace: robots move and send as in the trace, and messages are flooded") {
    const RecordedDay day = read_ns2_day(sample, {});
    CHECK(day.robots() == std::vector<std::string>{"n0", "n1", "n2", "n3"});
    CHECK(day.recorded().metrics.messages == 15);
    CHECK(day.recorded().metrics.deliveries == 10);
    const PlayedDay first = day.play({});
    CHECK(first.metrics.messages == 15);
    CHECK(first.metrics.deliveries == 10);  // all while robot 2 is less than 250 m from robot 1
    CHECK(first.metrics.max_hops == 3);
    CHECK(*first.metrics.delivery_ratio == 10.0 / 15);
    for (const Delivery& each : first.deliveries) CHECK(each.at == NodeId{3});
    CHECK(deliveries(day, {"radio.power=40 dBm"}) == 15);
    CHECK(deliveries(day, {"radio.power=0 dBm"}) == 0);
}

TEST_CASE("replay of an ns-2 trace: without routing, messages reach robots that hear the sender") {
    const RecordedDay day = read_ns2_day(sample, {.routing = DayRouting::direct, .movements = {}});
    CHECK(deliveries(day) == 0);
    const PlayedDay strong = day.play({"radio.power=50 dBm"});
    CHECK(strong.metrics.deliveries == 15);
    CHECK(strong.metrics.max_hops == 1);
    CHECK(strong.metrics.receptions == 15);  // a unicast is for nobody else
}

TEST_CASE("replay of an ns-2 trace: simultaneous senders draw a backoff first, as in ns-2") {
    const TemporaryFolder folder;
    const auto day_of = [&](double apart) {
        std::string text = move_line(0, 0) + move_line(1, 50) + move_line(2, -50);
        for (int i = 0; i < 40; ++i)
            text += said(1 + i, 2 * i, 1, "0") + said(1 + i + apart, 2 * i + 1, 2, "0");
        return read_ns2_day(folder.write("together.tr", text), {});
    };
    const RecordedDay together = day_of(0);
    // Both of 31 slots are the same once in 31 times, and then both messages are lost.
    CHECK(deliveries(together) >= 80 - 2 * 6);
    CHECK(deliveries(together, {"access.immediate_access=true"}) == 0);
    CHECK(together.starts_together({}).empty());
    for (const char* access :
         {"access.immediate_access=true", "access.model=aloha", "access.model=none"}) {
        CHECK(together.starts_together({access}).starts_with("80 of 80 messages are sent at "));
        CHECK(day_of(0.002).starts_together({access}).empty());
    }
    // Within a frame of 118 bytes and its preamble, 1.1 ms, where nobody listens.
    CHECK(day_of(0.0005).starts_together({"access.model=aloha"}).starts_with("80 of 80"));
    CHECK(day_of(0.0005).starts_together({"access.immediate_access=true"}).empty());
    CHECK(deliveries(day_of(0.0005), {"access.model=aloha"}) == 0);
    CHECK(together.starts_together({"access.model=aloha", "reception.model=threshold"}).empty());
}

TEST_CASE("replay of an ns-2 trace: lines that are not in ns-2 format are counted in a notice") {
    const TemporaryFolder folder;
    const RecordedDay day =
        read_ns2_day(folder.write("half.tr", move_line(0, 0) + move_line(1, 50) +
                                                 "s 1.0 garbage\n" + said(1, 0, 0, "1")),
                     {});
    REQUIRE(day.notices().size() == 1);
    CHECK(day.notices()[0] ==
          "1 of 4 lines are not in ns-2 format and are left out; the first is line 3");
}

TEST_CASE(
    "replay of an ns-2 trace: if a recorded reception is beyond the range, a notice names a "
    "sufficient power") {
    const TemporaryFolder folder;
    const auto day_of = [&](double metres) {
        const std::string heard =
            "r 1.005 _1_ RTR  --- 0 cbr 84 [13a 1 0 800] ------- [0:0 1:0 32 1] [0] 1 0\n"
            "r 1.005 _1_ AGT  --- 0 cbr 84 [13a 1 0 800] ------- [0:0 1:0 32 1] [0] 1 0\n";
        return read_ns2_day(
            folder.write("far.tr", move_line(0, 0) + move_line(1, metres) + said(1, 0, 0, "1") +
                                       "s 1.000 _0_ RTR  --- 0 cbr 84 [0 0 0 0] ------- [0:0 1:0 "
                                       "32 1] [0] 0 0\n" +
                                       heard),
            {});
    };
    CHECK(day_of(240).hears_farther({}).empty());
    const RecordedDay far = day_of(397);
    CHECK(deliveries(far) == 0);
    const std::string told = far.hears_farther({});
    CAPTURE(told);
    // 40 log10(397 / 250) = 8.03 dB over flat ground.
    CHECK(told.find("n1 received a frame of n0 over 397 m at 1.005000 s, but with the radio of "
                    "this row, the received power is 8.0 dB below") != std::string::npos);
    CHECK(told.find("--as \"radio.power=32.6 dBm\"") != std::string::npos);
    CHECK(deliveries(far, {"radio.power=32.6 dBm"}) == 1);
    CHECK(far.hears_farther({"radio.power=32.6 dBm"}).empty());
    const std::vector<std::string> disc = {"propagation.model=disc", "propagation.range=100 m"};
    CHECK(far.hears_farther(disc).find("reaches only 100 m; give this radio a larger range: --as "
                                       "\"propagation.model=disc;propagation.range=397 m\"") !=
          std::string::npos);
    CHECK(far.hears_farther({"propagation.model=disc", "propagation.range=397 m"}).empty());
}

TEST_CASE("replay of an ns-2 trace: broadcasts are sent to everyone in range") {
    const TemporaryFolder folder;
    const std::string trace = folder.write(
        "all.tr", move_line(0, 0) + move_line(1, 200) + move_line(2, 400) + said(1, 0, 0, "-1"));
    CHECK(deliveries(read_ns2_day(trace, {})) == 2);
    CHECK(deliveries(read_ns2_day(trace, {.routing = DayRouting::direct, .movements = {}})) == 1);
}

TEST_CASE("replay of an ns-2 trace: the range of the default radio is 250 m") {
    const TemporaryFolder folder;
    for (const double x : {249.9, 250.1}) {
        const std::string trace =
            folder.write("pair.tr", move_line(0, 0) + move_line(1, x) + said(1, 0, 0, "1"));
        CHECK(deliveries(read_ns2_day(trace, {})) == (x < 250 ? 1 : 0));
    }
}

TEST_CASE("replay of an ns-2 trace: a robot whose position is in no file is an error") {
    const TemporaryFolder folder;
    const std::string trace = folder.write("lost.tr", move_line(0, 0) + said(1, 0, 0, "1"));
    CHECK_THROWS_WITH_AS(
        read_ns2_day(trace, {}),
        doctest::Contains(
            "found no position of robot 1: an ns-2 trace in the old format has no position"),
        InputError);
    const std::string file =
        folder.write("way.tcl",
                     "$node_(0) set X_ 0\n$node_(0) set Y_ 0\n$node_(1) set X_ 100\n"
                     "$node_(1) set Y_ 0\n$node_(2) set X_ 0\n$node_(2) set Y_ 100\n");
    const RecordedDay day = read_ns2_day(trace, {.routing = {}, .movements = file});
    CHECK(day.robots().size() == 3);
    CHECK(deliveries(day) == 1);
    const std::string short_file =
        folder.write("one.tcl", "$node_(0) set X_ 0\n$node_(0) set Y_ 0\n");
    CHECK_THROWS_WITH_AS(read_ns2_day(trace, {.routing = {}, .movements = short_file}),
                         doctest::Contains("one.tcl: found no position of robot 1"), InputError);
}

TEST_CASE(
    "replay of an ns-2 trace: messages to their own sender or to no robot are skipped and "
    "counted") {
    const TemporaryFolder folder;
    const std::string trace =
        folder.write("own.tr", move_line(0, 0) + move_line(1, 9) + said(1, 0, 0, "0") +
                                   said(2, 1, 0, "4194305") + said(3, 2, 0, "1"));
    const RecordedDay day = read_ns2_day(trace, {});
    CHECK(day.notices() ==
          std::vector<std::string>{"2 messages are left out, because each of them was sent to its "
                                   "own sender, or to a robot that is not in the trace"});
    CHECK(day.play({}).metrics.messages == 1);
}

TEST_CASE("replay of an ns-2 trace: a trace without robots is refused") {
    const TemporaryFolder folder;
    const std::string wired = folder.write("w.tr", "+ 0.1 1 2 cbr 1000 ------- 2 1.0 3.1 0 0\n");
    CHECK_THROWS_WITH_AS(read_ns2_day(wired, {}), doctest::Contains("there is no robot"),
                         InputError);
}

TEST_CASE("replay of an ns-2 trace: from M lines (movements) alone, positions are exact to 15 cm") {
    std::string traces, movements;
    if (!find_pair(traces, movements)) return;
    for (const char* name : {"old_aodv_mac.tr", "old_dsdv.tr", "old_dsr.tr"}) {
        const Told told = told_by(traces + name);
        Truth truth(movements);
        REQUIRE(truth.size() == 10);
        double worst = 0;
        for (Time t = start_of_run; t <= start_of_run + 30s; t += 10ms) {
            for (NodeId n{0}; n.value < 10; ++n.value) {
                const Vec3 found = place_on(told.legs[n.index()], t);
                worst = std::max(worst, distance(found, truth.place(n, t)));
            }
        }
        CHECK(worst <= 0.15);
        CHECK(worst > 0.01);  // else the comparison compares nothing
    }
}

TEST_CASE(
    "replay of an ns-2 trace: with packet lines of the new format, positions are within 1 cm of "
    "those of the movement file") {
    std::string traces, movements;
    if (!find_pair(traces, movements)) return;
    const Told told = told_by(traces + "new_aodv_mac.tr");
    Truth truth(movements);
    double worst = 0;
    for (const Place& line : told.lines) {
        const Vec3 found = place_on(told.legs[line.node.index()], line.time);
        worst = std::max(worst, distance(found, truth.place(line.node, line.time)));
    }
    CHECK(told.lines.size() > 2000);
    CHECK(worst <= 0.01);
    const RecordedDay day = read_ns2_day(traces + "new_aodv_mac.tr", {});
    CHECK(day.robots().size() == 10);
    CHECK(deliveries(day) > 0);
}

TEST_CASE("replay of an ns-2 trace: packet lines of the tagged format have positions") {
    std::string traces, movements;
    if (!find_pair(traces, movements)) return;
    const RecordedDay day = read_ns2_day(traces + "aodv_tag.tr", {});
    CHECK(day.robots().size() == 4);
    CHECK(deliveries(day) > 0);
}

}  // namespace ns2_day_test
