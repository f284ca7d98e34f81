// SPDX-License-Identifier: MIT
#include "study/measurement.hpp"

#include "mobility/kept_planners.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "study/study.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace measurement_test {
using namespace rovernet;

namespace {

/// A map of 16 m x 8 m as a picture, one pixel a metre: a wall with one door at row `door`.
std::string map_with_door(int door) {
    std::string pixels;
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 16; ++column)
            pixels += column == 8 && row != door ? '\0' : '\xff';
    return "P5\n16 8\n255\n" + pixels;
}

constexpr const char* walkers = R"([scenario]
name = "walkers"
duration = "60 s"
[scene]
map = "one.pgm"
size = ["16 m", "8 m"]
[propagation]
model = "raytrace_2007"
[[robot]]
name = "A"
at = ["2 m", "4 m"]
radius = "0.3 m"
move = { model = "waypoints", path = [["14 m", "4 m"], ["2 m", "4 m"], ["14 m", "4 m"]], speed = "1 m/s" }
[[robot]]
name = "w"
count = 3
move = { model = "random_waypoint" }
[[traffic]]
from = "A"
payload = "F"
every = "1 s"
[study]
replications = 2
vary.scene.map = ["one.pgm", "two.pgm"]
vary.robot.A.radius = ["0.3 m", "0.4 m"]
)";

}  // namespace

TEST_CASE("measurement: if a robot gets none of three messages, its delivery ratio is 0") {
    test::TemporaryFolder folder;
    folder.write("s.toml", R"([scenario]
duration = "5 s"
[propagation]
model = "disc"
range = "50 m"
[metrics]
robots = true
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "C"
at = ["900 m", "0 m"]
[[traffic]]
from = "A"
payload = "F"
every = "1 s"
count = 3
[study]
metrics = ["delivery_ratio.at.C", "messages.at.C"]
)");
    Study study(folder.path("s.toml"), {});
    KeptPlanners kept;
    std::map<std::string, std::optional<double>> values;
    for (const MetricValue& each : measure(study.scenario(0, 0), kept).metrics)
        values[each.name] = each.value;
    CHECK(values["delivery_ratio.at.C"] == 0.0);
    CHECK(values["messages.at.C"] == 3.0);
}

TEST_CASE(
    "measurement: runs that alternate between two maps give the same results as separate runs") {
    test::TemporaryFolder folder;
    folder.write("one.pgm", map_with_door(1));
    folder.write("two.pgm", map_with_door(6));
    folder.write("s.toml", walkers);
    Study study(folder.path("s.toml"), {});
    REQUIRE(study.points().size() == 4);
    KeptPlanners shared;
    std::vector<std::string> fingerprints;
    for (std::uint32_t replication = 0; replication < 2; ++replication)
        for (std::size_t point = 0; point < 4; ++point) {
            const Scenario scenario = study.scenario(point, replication);
            KeptPlanners fresh;
            const Measurement alone = measure(scenario, fresh);
            const Measurement after_others = measure(scenario, shared);
            CHECK(after_others.fingerprint == alone.fingerprint);
            CHECK(after_others.metrics == alone.metrics);
            fingerprints.push_back(alone.fingerprint);
        }
    CHECK(fingerprints[0] != fingerprints[2]);  // the doors lie elsewhere
}

TEST_CASE("measurement: a map that changed between two runs is read again for the second run") {
    test::TemporaryFolder folder;
    folder.write("one.pgm", map_with_door(1));
    folder.write("s.toml", std::string(walkers).substr(0, std::string(walkers).find("[study]")));
    KeptPlanners kept;
    const auto fingerprint = [&] {
        const Scenario scenario = ScenarioFile(folder.path("s.toml"), {}).scenario();
        KeptPlanners fresh;
        const Measurement m = measure(scenario, kept);
        CHECK(m.fingerprint == measure(scenario, fresh).fingerprint);
        return m.fingerprint;
    };
    const std::string before = fingerprint();
    folder.write("one.pgm", map_with_door(6));
    CHECK(fingerprint() != before);
    folder.write("one.pgm", map_with_door(1));
    CHECK(fingerprint() == before);
}

TEST_CASE(
    "measurement: the names of a run's metrics are known before the run, even without its map") {
    test::TemporaryFolder folder;
    folder.write("one.pgm", map_with_door(1));
    const std::string text = std::string(walkers).substr(0, std::string(walkers).find("[study]")) +
                             "[metrics]\nrobots = true\ntopology = true\n";
    folder.write("s.toml", text);
    const Scenario scenario = ScenarioFile(folder.path("s.toml"), {}).scenario();
    KeptPlanners kept;
    const Measurement m = measure(scenario, kept);
    std::vector<std::string> measured;
    for (const MetricValue& metric : m.metrics) measured.push_back(metric.name);
    Scenario without_map = scenario;
    without_map.walls = nullptr;
    std::filesystem::remove(folder.path("one.pgm"));
    CHECK(metric_names(without_map) == measured);
    for (const char* name : {"drops.DUP", "latency_p95_s", "warmup_s", "throughput_bps.A->all",
                             "delivery_ratio.at.w2", "link_lifetime_mean_s"})
        CHECK(std::find(measured.begin(), measured.end(), name) != measured.end());
}

TEST_CASE("measurement: a measurement is written as text and read back unchanged") {
    const Measurement sent{.metrics = {{"a name.with blanks", 0.1 + 0.2}, {"none", {}}},
                           .fingerprint = "0123-4567",
                           .cpu_s = 1.25,
                           .wall_s = 1e-9,
                           .started = "2000-01-01T00:00:00Z",
                           .host = "this one",
                           .searches = 7};
    CHECK(measurement_of(to_text(sent)) == sent);
}

}  // namespace measurement_test
