// SPDX-License-Identifier: MIT
#include "study/probe/probe.hpp"

#include "scenario/scenario_file.hpp"
#include "scene/scene.hpp"
#include "sim/random.hpp"
#include "study/probe/displaced.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace probe_test {
using namespace rovernet;
using test::disc;
using test::drawn_map;
using test::near;
using test::two_robots;

namespace {

Scenario scenario_from(const std::string& text) {
    const test::TemporaryFolder folder;
    return load_scenario(folder.write("s.toml", text), {});
}

const PerturbationEffect& named(const Probe& probe, std::string_view name) {
    const auto found = std::find_if(probe.perturbations.begin(), probe.perturbations.end(),
                                    [&](const PerturbationEffect& p) { return p.name == name; });
    REQUIRE(found != probe.perturbations.end());
    return *found;
}

const std::string walls = R"([propagation]
model = "raytrace_2007"
wall_factor = 0.5
)";

/// The walls that stand between A and B.
Scenario with_walls(double x, const std::vector<std::string>& rows, const std::string& more) {
    Scenario scenario = scenario_from(two_robots(x, more));
    OccupancyGrid map = drawn_map(rows, 0.1);
    map.origin = {1, -1};
    scenario.walls = std::make_shared<const Scene>(std::move(map));
    return scenario;
}

std::vector<std::string> rows_of(int rows, const std::string& row) {
    return std::vector(static_cast<std::size_t>(rows), row);
}

}  // namespace

TEST_CASE(
    "probe: in free space a shift of 1 cm changes the loss as Friis' formula predicts, and no link "
    "goes up or down") {
    const Probe found = probe(scenario_from(two_robots(50, "")), {});
    CHECK(found.model == "friis");
    CHECK(found.links == 1);
    const PerturbationEffect& moved = named(found, "1 cm");
    const double slope = 20 * std::log10(50 / 49.99);  // towards B, the steeper way
    CHECK(near(std::abs(moved.worst), slope, 1e-6));
    CHECK(near(moved.steepest, slope / 10, 1e-7));
    CHECK(moved.flips + moved.lost + moved.gained == 0);
    CHECK(found.effects.empty());
    CHECK(found.deliveries == 4);  // of the message at the end nothing is left
    CHECK(found.whole_run);
}

TEST_CASE(
    "probe: at the range of the model `disc`, a shift of 1 um breaks the link, and is listed "
    "first, as a cliff") {
    const Probe found = probe(scenario_from(two_robots(10, disc)), {});
    REQUIRE(found.effects.size() == 2);
    const LinkEffect& first = found.effects.front();
    CHECK(first.perturbation.starts_with("1 um"));
    CHECK(first.is_cliff());
    CHECK(first.was_up());
    CHECK_FALSE(first.is_up());
    CHECK(named(found, "1 um").flips == 1);
    CHECK(found.effects.back().perturbation.starts_with("1 cm"));
}

TEST_CASE("probe: messages that a displaced robot misses are counted and listed") {
    const Displaced displaced{Friis{}, Meters{0.01}};
    const Vec3 a = displaced.displacement(name_key("A")), b = displaced.displacement(name_key("B"));
    std::uint64_t lost = 0;
    for (const Vec3 way : {Vec3{1, 0}, Vec3{0, 1}, Vec3{-1, 0}, Vec3{0, -1}}) {
        const Vec3 at = 9.9999999 * way;
        Scenario scenario = scenario_from(two_robots(0, disc));
        scenario.robots[1].at = at;
        const Probe found = probe(scenario, {});
        const PerturbationEffect& moved = named(found, "1 cm");
        CHECK(found.deliveries == 4);
        CHECK(moved.lost == (distance(a, at + b) > 10 ? 4 : 0));
        lost += moved.lost;
        if (moved.lost == 0) continue;
        REQUIRE_FALSE(found.messages.empty());
        const MessageEffect& first = found.messages.front();
        CHECK(first.from == "A");
        CHECK(first.at == "B");
        CHECK(first.number == 0);
        CHECK(first.sent == start_of_run + std::chrono::seconds{1});
        CHECK_FALSE(first.gained);
    }
    CHECK(lost > 0);
}

TEST_CASE(
    "probe: the loss of a link along the face of a wall jumps after a shift of 1 um, and is listed "
    "as a cliff") {
    // The face is the line y = 0, from x = 1 m to 2 m.
    const Probe found = probe(with_walls(4, rows_of(10, ".........."), walls), {.events = 0});
    CHECK(std::none_of(found.effects.begin(), found.effects.end(),
                       [](const LinkEffect& e) { return e.is_cliff(); }));
    std::vector<std::string> above = rows_of(10, "##########");
    for (const std::string& row : rows_of(10, "..........")) above.push_back(row);
    const Probe grazing = probe(with_walls(4, above, walls), {.events = 0});
    REQUIRE_FALSE(grazing.effects.empty());
    const LinkEffect& first = grazing.effects.front();
    CHECK(first.is_cliff());
    CHECK(first.perturbation.starts_with("1 um north"));
    CHECK(near(first.change(), 50, 0.1));  // it passes a metre of the wall
}

TEST_CASE(
    "probe: effects are listed in this order: cliffs (steep losses), flipped links, other changes "
    "by size") {
    const Scenario scenario = with_walls(60, rows_of(20, "#.###.###."), walls);
    const Probe found = probe(scenario, {.events = 0});
    const auto group = [](const LinkEffect& e) { return e.is_cliff() ? 0 : e.flips() ? 1 : 2; };
    for (std::size_t i = 1; i < found.effects.size(); ++i) {
        const LinkEffect &a = found.effects[i - 1], &b = found.effects[i];
        CHECK(group(a) <= group(b));
        if (group(a) != group(b)) continue;
        if (group(a) == 0) {
            CHECK(a.steepness() >= b.steepness());
        } else {
            CHECK(std::abs(a.change()) >= std::abs(b.change()));
        }
    }
    CHECK(found.effects.size() >= 3);
}

TEST_CASE(
    "probe: a wall that is drawn thicker breaks the link, and messages over this link are lost") {
    // As given 0.3 m of wall take 15 dB; joined cells make it 0.4 m, and 20 dB.
    Scenario scenario = with_walls(4, rows_of(20, ".###......"), walls);
    const double loss = 40.2 + 30 * std::log10(4.0) + 15;
    scenario.radio.sensitivity = Dbm{scenario.radio.power.value - loss - 2.5};
    for (RobotTable& robot : scenario.robots) robot.radio = scenario.radio;
    const Probe found = probe(scenario, {});
    const PerturbationEffect& joined = named(found, "resolution x0.5");
    CHECK(near(joined.worst, 5, 1e-6));
    CHECK(joined.flips == 1);
    CHECK(joined.lost == 4);
    CHECK(named(found, "resolution x2").lost == 0);
    CHECK(near(named(found, "resolution x2").worst, 0, 1e-9));
    CHECK(named(found, "walls +3 dB").lost == 4);
    CHECK(named(found, "walls -3 dB").gained == 0);
}

TEST_CASE("probe: a run with too many events is compared only up to a time, which is reported") {
    Scenario scenario = scenario_from(two_robots(50, ""));
    scenario.traffic.front().every = std::chrono::milliseconds{1};
    const Probe found = probe(scenario, {.events = 1});
    CHECK_FALSE(found.whole_run);
    CHECK(found.until < start_of_run + std::chrono::seconds{5});
}

TEST_CASE("probe: robots are placed as in the replication that the scenario selects") {
    const std::string area = R"([scenario]
duration = "5 s"
[[robot]]
name = "r"
count = 2
place = { area = [["0 m", "0 m"], ["50 m", "50 m"]] }
)";
    Scenario scenario = scenario_from(area);
    scenario.scenario.replication = 7;
    const Probe found = probe(scenario, {.events = 0});
    scenario.scenario.replication = 8;
    const Probe other = probe(scenario, {.events = 0});
    CHECK(found.links == 1);
    CHECK(named(found, "1 cm").worst != named(other, "1 cm").worst);
}

TEST_CASE("probe: a scenario in which no robots come into range is refused") {
    CHECK_THROWS_WITH_AS(
        probe(scenario_from(two_robots(50, "[propagation]\nmodel = \"disc\"\nrange = \"1 m\"\n")),
              {}),
        doctest::Contains("according to the propagation model disc, no two robots come within "
                          "range of each other"),
        InputError);
}

TEST_CASE("probe: the reported progress goes from 0 to 1") {
    double last = 0;
    probe(scenario_from(two_robots(50, "")), {}, [&](double share) {
        CHECK(share >= last);
        last = share;
    });
    CHECK(last == 1);
}

}  // namespace probe_test
