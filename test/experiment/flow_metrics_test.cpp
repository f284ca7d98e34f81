// SPDX-License-Identifier: MIT
#include "experiment/run.hpp"
#include "experiment/summary.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace flow_metrics_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

const std::string three = R"(
[[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["10 m", "0 m"]
[[robot]]
name = "c"
at = ["20 m", "0 m"]
)";

Scenario loaded(const TemporaryFolder& folder, const std::string& text) {
    return load_scenario(folder.write("s.toml", text), {});
}

Table summary(const std::string& text) {
    const TemporaryFolder folder;
    const Scenario scenario = loaded(folder, text);
    return run_summary(scenario,
                       run_scenario(scenario, {.folder = folder.path("out"), .speed = {}}));
}

/// A number of a part: number(summary, {"flows", "a->b", "deliveries"}).
double number(const Table& table, const std::vector<std::string>& path) {
    const Table* at = &table;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const Value* next = at->find(path[i]);
        REQUIRE_MESSAGE(next, path[i]);
        at = next->table();
    }
    const Value* value = at->find(path.back());
    REQUIRE(value);
    if (const auto* whole = std::get_if<std::int64_t>(&value->data)) {
        return static_cast<double>(*whole);
    }
    return std::get<double>(value->data);
}

}  // namespace

TEST_CASE("flows: in the summary, a flow without a name is named after its sender and receiver") {
    const Table table = summary(three + R"(
[[traffic]]
kind = "unicast"
from = "a"
to = "b"
size = "125 B"
every = "1 s"
count = 4
[[traffic]]
name = "news"
from = "c"
payload = "F"
[[traffic]]
from = "a"
payload = "G"
[[traffic]]
from = "a"
payload = "H"
)" + "[scenario]\nduration = \"10 s\"\n");
    CHECK(number(table, {"flows", "a->b", "messages"}) == 4);
    CHECK(number(table, {"flows", "a->b", "delivery_ratio"}) == 1);
    CHECK(number(table, {"flows", "a->b", "throughput_bps"}) == 400);
    CHECK(number(table, {"flows", "news", "deliveries"}) == 2);
    CHECK(number(table, {"flows", "a->all", "messages"}) == 1);
    CHECK(number(table, {"flows", "a->all#2", "messages"}) == 1);
    CHECK_FALSE(table.find("robots"));
    CHECK_FALSE(table.find("topology"));
}

TEST_CASE(
    "flows: equal names, and names with characters that a metric's name cannot have, are refused") {
    const TemporaryFolder folder;
    const std::string flow = "[[traffic]]\nfrom = \"a\"\npayload = \"F\"\nname = ";
    CHECK_THROWS_AS(loaded(folder, three + flow + "\"x\"\n" + flow + "\"x\"\n"), InputError);
    CHECK_THROWS_AS(loaded(folder, three + flow + "\"x y\"\n"), InputError);
    CHECK_THROWS_AS(loaded(folder, three + flow + "\"x,y\"\n"), InputError);
}

TEST_CASE(
    "random sources: all robots are chosen as sender equally often, in any order of the file") {
    const std::string traffic =
        "[[traffic]]\nfrom = \"random\"\npayload = \"F\"\nevery = \"10 ms\"\ncount = 300\n"
        "[metrics]\nrobots = true\n[scenario]\nduration = \"4 s\"\n";
    const Table forwards = summary(three + traffic);
    const auto robot = [](const std::string& name, int x) {
        return "[[robot]]\nname = \"" + name + "\"\nat = [\"" + std::to_string(x) +
               " m\", \"0 m\"]\n";
    };
    const Table backwards = summary(robot("c", 20) + robot("b", 10) + robot("a", 0) + traffic);
    for (const std::string name : {"a", "b", "c"}) {
        const double for_it = number(forwards, {"robots", name, "messages"});
        CHECK(for_it > 150);  // of 300 those that others send: 200 and a few standard deviations
        CHECK(for_it < 250);
        CHECK(for_it == number(backwards, {"robots", name, "messages"}));
        CHECK(number(forwards, {"robots", name, "delivery_ratio"}) == 1);
    }
}

TEST_CASE("metrics by robot: `messages` includes broadcasts that the robot did not receive") {
    const auto check = [](const std::string& robots) {
        const Table table = summary(robots + R"(
[scenario]
duration = "10 s"
[propagation]
model = "disc"
range = "50 m"
[metrics]
robots = true
[[traffic]]
from = "A"
size = "64 B"
every = "1 s"
count = 5
)");
        CHECK(number(table, {"robots", "B", "delivery_ratio"}) == 1);
        for (const std::string name : {"C", "off"}) {
            CAPTURE(name);
            CHECK(number(table, {"robots", name, "messages"}) == 5);
            CHECK(number(table, {"robots", name, "deliveries"}) == 0);
            CHECK(number(table, {"robots", name, "delivery_ratio"}) == 0);
        }
    };
    const std::string near =
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"B\"\nat = [\"40 m\", \"0 m\"]\n";
    const std::string far =
        "[[robot]]\nname = \"C\"\nat = [\"900 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"off\"\nat = [\"20 m\", \"0 m\"]\noff = [\"0 s\"]\n";
    check(near + far);
    check(far + near);
}

TEST_CASE("flows: a routed unicast that collides and is sent again does not count as lost") {
    const Table table = summary(R"(
[scenario]
duration = "5 s"
[propagation]
model = "disc"
range = "250 m"
[reception]
model = "collision"
[access]
model = "aloha"
[routing]
protocol = "dsr"
[[robot]]
name = "n0"
at = ["0 m", "0 m"]
[[robot]]
name = "n1"
at = ["200 m", "0 m"]
[[robot]]
name = "n2"
at = ["400 m", "0 m"]
[[traffic]]
name = "routed"
kind = "unicast"
from = "n0"
to = "n1"
size = "1000 B"
start = "1 s"
every = "100 ms"
count = 3
[[traffic]]
name = "noise"
from = "n2"
size = "1000 B"
start = "1.1 s"
every = "100 ms"
count = 3
)");
    CHECK(number(table, {"flows", "routed", "deliveries"}) == 3);
    CHECK(number(table, {"data_transmissions"}) > 3);
    const Value* drops = table.find("flows")->table()->find("routed")->table()->find("drops");
    REQUIRE(drops);
    CHECK(drops->table()->entries.empty());
    CHECK(number(table, {"drops", "COL"}) == 2);  // of the noise
}

TEST_CASE("topology: metrics of a robot that passes another robot equal values computed by hand") {
    // b passes a at 2 m/s, from 20 m before it to 20 m behind it: in range of 10 m from 5 s to 15
    // s.
    const Table table = summary(R"(
[scenario]
duration = "20 s"
[metrics]
topology = true
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["-20 m", "0 m"]
move = { model = "waypoints", path = [["20 m", "0 m"]], speed = "2 m/s" }
)");
    constexpr double tolerance = 1e-6;  // to which link changes are looked for [s]
    const auto is = [&](const char* name, double expected) {
        CHECK(std::abs(number(table, {"topology", name}) - expected) <= tolerance);
    };
    is("degree_mean", 0.5);
    is("speed_mean_m_s", 1);
    is("link_lifetime_mean_s", 10);
    is("links_ended", 2);
    // Samples at 0 ... 20 s: one part at 5 ... 15 s, perhaps not at the two ends.
    CHECK(number(table, {"topology", "components_mean"}) >= 1 + 10.0 / 21 - tolerance);
    CHECK(number(table, {"topology", "components_mean"}) <= 1 + 12.0 / 21 + tolerance);
}

}  // namespace flow_metrics_test
