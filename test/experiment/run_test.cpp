// SPDX-License-Identifier: MIT
#include "experiment/run.hpp"

#include "experiment/reports/link_report.hpp"
#include "experiment/summary.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/traces/ns2/trace_metrics.hpp"

#include <doctest/doctest.h>

#include <filesystem>

namespace run_test {
using namespace rovernet;
using rovernet::test::TemporaryFolder;
using rovernet::testing::trace_metrics;

namespace {

Scenario three_robots(const std::string& format) {
    const std::string text = R"(
[scenario]
duration = "20 s"
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["8 m", "0 m"]
move = { model = "waypoints", path = [["8 m", "5 m"]], speed = "0.5 m/s" }
off = ["9 s"]
on = ["14 s"]
[[robot]]
name = "C"
at = ["16 m", "0 m"]
[[traffic]]
from = "A"
payload = "F"
every = "1 s"
[trace]
ns2 = ")" + format + "\"\n";
    return read_scenario(parse_toml(text, "s.toml"), "s.toml");
}

std::string json_of(const MetricValues& metrics) {
    Table table;
    append_metrics(table, metrics);
    return to_json(table);
}

}  // namespace

TEST_CASE("run: metrics of the trace equal those of the run to the last digit") {
    for (const char* format : {"old", "new"}) {
        const TemporaryFolder folder;
        const RunResult result =
            run_scenario(three_robots(format), {.folder = folder.path("out"), .speed = {}});
        REQUIRE(result.trace);
        CHECK(result.metrics.deliveries > 0);
        CHECK(result.metrics.deliveries < 2 * result.metrics.messages);
        CHECK(json_of(trace_metrics(*result.trace)) == json_of(result.metrics));
    }
}

TEST_CASE("run: the fingerprint is the same with and without a trace file") {
    const TemporaryFolder folder;
    const RunOptions options{.folder = folder.path("out"), .speed = {}};
    const std::string once = run_scenario(three_robots("none"), options).fingerprint;
    CHECK(run_scenario(three_robots("new"), options).fingerprint == once);
    Scenario other = three_robots("none");
    other.scenario.seed = 2;
    CHECK(run_scenario(other, options).fingerprint != once);
}

TEST_CASE("run: a stopped run leaves no files") {
    const TemporaryFolder folder;
    const RunOptions options{.folder = folder.path("out"),
                             .speed = {},
                             .progress = [](double share) { return share == 0; }};
    CHECK_THROWS_AS(run_scenario(three_robots("new"), options), Interrupted);
    CHECK(std::filesystem::is_empty(folder.path("out")));
}

TEST_CASE("run: the next run removes unfinished files of a killed run, except its log of inputs") {
    for (const bool is_recorded : {false, true}) {
        CAPTURE(is_recorded);
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder.path("out"));
        for (const char* part :
             {"trace.mcap.77.part", "trace.tr.78.part", "summary.json.79.part"}) {
            folder.write(std::string("out/") + part, "");
        }
        folder.write("out/inputs.jsonl.80.part", "");
        Scenario scenario = three_robots("none");
        scenario.trace.record = is_recorded;
        run_scenario(scenario, {.folder = folder.path("out"), .speed = {}});
        for (const auto& entry : std::filesystem::directory_iterator(folder.path("out"))) {
            const std::string name = entry.path().filename();
            CHECK((name == "inputs.jsonl.80.part" || !name.ends_with(".part")));
        }
        CHECK(std::filesystem::exists(folder.path("out/inputs.jsonl.80.part")));
    }
}

TEST_CASE("run: a run stopped before its first event creates no folder") {
    const TemporaryFolder folder;
    const RunOptions options{
        .folder = folder.path("out"), .speed = {}, .progress = [](double) { return false; }};
    CHECK_THROWS_AS(run_scenario(three_robots("new"), options), Interrupted);
    CHECK_FALSE(std::filesystem::exists(folder.path("out")));
}

TEST_CASE("run: a run beyond the event limit fails and leaves no files") {
    const TemporaryFolder folder;
    Scenario scenario = three_robots("new");
    scenario.scenario.event_limit = 5;
    CHECK_THROWS_AS(run_scenario(scenario, {.folder = folder.path("out"), .speed = {}}), RunError);
    CHECK(std::filesystem::is_empty(folder.path("out")));
}

TEST_CASE(
    "link report: at a distance of 16 m the loss is that of free space, and the margin is level "
    "minus sensitivity") {
    Scenario scenario = three_robots("none");
    scenario.propagation.model = 1;
    const auto report = report_link(scenario, "A", "C", start_of_run);
    constexpr double half_digit = 0.005;  // of 64.31 dB, free space at 16 m and 2450 MHz
    CHECK(report.distance_m == 16);
    CHECK(std::abs(report.path_loss.value - 64.31) < half_digit);
    CHECK(std::abs(report.margin.value - (report.received - scenario.radio.sensitivity).value) <
          1e-12);
    CHECK(report.up);
}

}  // namespace run_test
