// SPDX-License-Identifier: MIT
#include "experiment/replay/capture.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace disc_links_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// A line of robots under a model: A at 0 m, C at 60 m, D at 100 m, B at 150 m.
Scenario line(const std::string& model) {
    const std::string text = R"(
robot = [{ name = "A", at = ["0 m", "0 m"] }, { name = "B", at = ["150 m", "0 m"] },
         { name = "C", at = ["60 m", "0 m"] }, { name = "D", at = ["100 m", "0 m"] }]
[scenario]
name = "line"
duration = "2 s"
[[traffic]]
from = "A"
payload = "F"
start = "1 s"
[routing]
ttl = 1
[trace]
record = true
[propagation]
)" + model;
    return read_scenario(parse_toml(text, "s.toml"), "s.toml");
}

/// Whether each packet of a capture has a level: bits 5 and 6 of its radiotap header.
std::vector<bool> have_levels(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    std::vector<bool> all;
    for (std::size_t at = 0; at + 12 <= bytes.size(); at += number(at + 4)) {
        constexpr std::size_t head = 28, present = 4;  // of the block; place in radiotap
        if (number(at) == 6) all.push_back((number(at + head + present) & 0x60) == 0x60);
    }
    return all;
}

const std::string disc = "model = \"disc\"\nrange = \"100 m\"\n";

}  // namespace

TEST_CASE(
    "model `disc`: a link report has distance and range; if the distance equals the range, the "
    "link is up") {
    const Scenario scenario = line(disc);
    const LinkReport far = report_link(scenario, "A", "B", start_of_run);
    CHECK_FALSE(far.up);
    REQUIRE(far.range);
    CHECK(far.range->value == 100);
    CHECK(far.why_down == "150 m, beyond the sender's range of 100 m");
    const LinkReport near = report_link(scenario, "A", "D", start_of_run);
    CHECK(near.up);
    CHECK(near.range);
    CHECK_FALSE(report_link(line("model = \"friis\"\n"), "A", "B", start_of_run).range);
    const LinkReport shadowed =
        report_link(line(disc + "sigma = \"3 dB\"\n"), "A", "B", start_of_run);
    CHECK(shadowed.why_down == far.why_down);
}

TEST_CASE("model `disc`: the link table of a robot has distances and no levels") {
    const auto network = network_at(line(disc), start_of_run);
    std::size_t rows = 0;
    for_each_link_table(*network, "A", [&](const LinkTable& table) {
        const std::string json = to_json(link_table_document(table));
        CHECK(json.find("\"level_dbm\": null") != json.npos);
        CHECK(json.find("\"range_m\": 100.0") != json.npos);
        for (const LinkTable::Row& row : table.rows) {
            ++rows;
            CHECK(row.distance->value == (row.neighbour.robot == "C" ? 60 : 100));
        }
    });
    CHECK(rows == 2);
    const auto friis = network_at(line("model = \"friis\"\n"), start_of_run);
    for_each_link_table(*friis, "A", [&](const LinkTable& table) {
        CHECK(to_json(link_table_document(table)).find("null") == std::string::npos);
        for (const LinkTable::Row& row : table.rows) CHECK_FALSE(row.range);
    });
}

TEST_CASE(
    "model `disc`: a message is missed because of the distance; a packet capture has no levels") {
    const TempFolder folder;
    run_scenario(line(disc), {.folder = folder / "run", .speed = {}});
    const std::string trace = folder / "run/trace.mcap";
    const MessageAtRobot far = message_at_robot(trace, 0, NodeId{1});
    CHECK(sentence(far) ==
          "B was never in range: the only frame came from 150 m, beyond the sender's range of 100 "
          "m.");
    const MessageAtRobot near = message_at_robot(trace, 0, NodeId{2});
    CHECK(sentence(near).find("came over 60 m, within the sender's range of 100 m") !=
          std::string::npos);
    CHECK(sentence(near).find("dB") == std::string::npos);
    REQUIRE(near.frames.size() == 1);
    CHECK(near.frames[0].distance_m == 60);

    const auto levels = [&](const std::string& model) {
        run_scenario(line(model), {.folder = folder / "c", .speed = {}});
        capture_recorded(folder / "c/trace.mcap", folder / "c.pcapng");
        return have_levels(content(folder / "c.pcapng"));
    };
    CHECK(levels(disc) == std::vector<bool>{false, false, false});
    CHECK(levels("model = \"friis\"\n") == std::vector<bool>{false, true, true, true});
}

}  // namespace disc_links_test
