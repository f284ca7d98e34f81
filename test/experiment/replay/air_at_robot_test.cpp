// SPDX-License-Identifier: MIT
#include "experiment/replay/air_at_robot.hpp"

#include "experiment/run.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/recorded/recorded_index.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace air_at_robot_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// A recorded run of A at 0 m, B at 100 m and C at 2 km, whose messages go one hop.
struct Run {
    TempFolder folder;
    std::string path = folder / "trace.mcap";

    explicit Run(const std::string& more) {
        std::string text = "[scenario]\nduration = \"5 s\"\n[routing]\nttl = 1\n";
        for (const char* robot :
             {"A\"\nat = [\"0 m\"", "B\"\nat = [\"100 m\"", "C\"\nat = [\"2 km\""})
            text += std::string("[[robot]]\nname = \"") + robot + ", \"0 m\"]\n";
        write_file(folder / "s.toml", text + more);
        RunOptions to;
        to.folder = folder / ".";
        run_scenario(load_scenario(folder / "s.toml", {.set = {"trace.record=true"}}), to);
    }
    AirAtRobot at(std::uint32_t robot, Duration time) const {
        return air_at_robot(path, NodeId{robot}, start_of_run + time);
    }
};

/// Traffic of 1375 bytes, 192 us + 1 ms at 11 Mbit/s, ten times a second.
std::string traffic(const std::string& from, const std::string& start) {
    return "[[traffic]]\nfrom = \"" + from +
           "\"\nsize = \"1375 B\"\nevery = \"100 ms\"\nstart = \"" + start + "\"\n";
}

constexpr Duration airtime{1'192'000};

}  // namespace

TEST_CASE(
    "air at a robot: ten frames occupy the channel for ten airtimes, at the sender and at a "
    "receiver") {
    const Run run(traffic("A", "50 ms"));
    const AirAtRobot sender = run.at(0, 3s), receiver = run.at(1, 3s), far = run.at(2, 3s);
    CHECK(sender.busy == 10 * airtime);
    CHECK(sender.sending == 10 * airtime);
    CHECK(sender.sent == 10);
    CHECK(sender.heard == 0);
    CHECK(receiver.busy == 10 * airtime);
    CHECK(receiver.sending == Duration{0});
    CHECK(receiver.heard == 10);
    REQUIRE(receiver.senders.size() == 1);
    CHECK(receiver.senders[0].first == NodeId{0});
    CHECK(receiver.senders[0].second == 10 * airtime);
    CHECK(far.busy == Duration{0});
    const AirAtRobot early = run.at(1, 200ms);
    CHECK(early.begin == start_of_run);
    CHECK(early.busy == 2 * airtime);
    // A time within a frame: the part until then counts.
    CHECK(run.at(0, 50ms + 1ms).busy == 1ms);
    CHECK(run.at(0, 1050ms + 1ms).busy == 9 * airtime + 1ms + (airtime - 1ms));
}

TEST_CASE("air at a robot: overlapping frames count once; a sensitive robot senses more frames") {
    const Run run(traffic("A", "50 ms") + traffic("B", "50 ms"));
    const AirAtRobot there = run.at(0, 3s);
    CHECK(there.sending == 10 * airtime);
    CHECK(there.heard == 10);
    // B's frames come 0.33 us after its own ones.
    CHECK(there.busy > 10 * airtime);
    CHECK(there.busy < 10 * airtime + 10 * 1us);
    const Run sensing("[radio]\ncarrier_sense_threshold = \"-100 dBm\"\n" + traffic("A", "50 ms"));
    CHECK(sensing.at(2, 3s).busy == 10 * airtime);
}

TEST_CASE(
    "air at a robot: an index of the trace does not change the result; an unknown robot is "
    "refused") {
    const Run run(traffic("A", "50 ms") + traffic("B", "33 ms"));
    RecordedReader reader(run.path);
    RecordedIndex index;
    while (const Record* record = reader.next())
        index.add(reader.chunk(), *record, reader.context());
    for (const Duration at : {0ms, 20ms, 1000ms, 3333ms, 5000ms}) {
        const AirAtRobot there = air_at_robot(run.path, NodeId{1}, start_of_run + at, &index);
        CHECK(to_json_line(document_of(there)) == to_json_line(document_of(run.at(1, at))));
    }
    CHECK_THROWS_AS(run.at(3, 1s), InputError);
}

}  // namespace air_at_robot_test
