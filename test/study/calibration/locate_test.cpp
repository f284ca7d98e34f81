// SPDX-License-Identifier: MIT
// Robots in a hall with an anchor in each corner, and measured levels of the same.
#include "study/calibration/locate.hpp"

#include "models/propagation/disc.hpp"
#include "models/propagation/friis.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/unlikely.hpp"
#include "sim/error.hpp"
#include "study/calibration/calibration.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace locate_test {
using namespace rovernet;

namespace {

using test::TemporaryFolder;

const std::vector<std::string> corners{"SW", "SE", "NE", "NW"};

/// One robot for each of many places, all at once.
Scenario hall(const std::string& shadowing, const std::string& set = {}) {
    const TemporaryFolder folder;
    ScenarioOptions options;
    if (!set.empty()) options.set.push_back(set);
    return load_scenario(folder.write("hall.toml", R"(
scenario = { name = "hall", duration = "10 s", seed = 3 }
propagation = { model = "log_distance", exponent = 2, sigma = "0 dB" }
robot = [
  { name = "SW", at = ["0 m", "0 m"] },
  { name = "SE", at = ["10 m", "0 m"] },
  { name = "NE", at = ["10 m", "10 m"] },
  { name = "NW", at = ["0 m", "10 m"] },
  { name = "R", count = 400, place = { area = [["3 m", "3 m"], ["7 m", "7 m"]] } },
]
)" + shadowing),
                         options);
}

}  // namespace

TEST_CASE(
    "locate: without shadowing positions are exact, with `log_distance` and with `multi_wall`") {
    for (const char* model : {"", "propagation.model=multi_wall"}) {
        const Located located =
            locate_robots(hall("", model), corners, {start_of_run}, {.sigma = Db{4}});
        REQUIRE(located.fixes.size() == 400);
        for (const Fix& fix : located.fixes) CHECK(*fix.error() <= 2e-3);
        CHECK(located.too_few == 0);
    }
}

TEST_CASE(
    "locate: robots at a given time are located with the doors that are closed at this time") {
    const TemporaryFolder folder;
    const Scenario scenario = load_scenario(folder.write("door.toml", R"([scenario]
name = "door"
duration = "30 s"
[scene]
map = ")" ROVERNET_EXAMPLES R"(/rescue/map.yaml"
[scene.materials]
steel = { per_crossing = "40 dB" }
[[scene.door]]
from = ["20.3 m", "13.3 m"]
to = ["21.7 m", "13.3 m"]
material = "steel"
closes = ["10 s"]
opens = ["20 s"]
[radio]
sensitivity = "-150 dBm"
[propagation]
model = "multi_wall"
[[robot]]
name = "SW"
at = ["20.5 m", "12 m"]
[[robot]]
name = "SE"
at = ["21.5 m", "12.2 m"]
[[robot]]
name = "NE"
at = ["24 m", "15 m"]
[[robot]]
name = "NW"
at = ["19.5 m", "16 m"]
[[robot]]
name = "R"
at = ["21 m", "15 m"]
)"),
                                            {});
    const auto at = [](int s) { return start_of_run + std::chrono::seconds{s}; };
    const Located all = locate_robots(scenario, corners, {at(0), at(15), at(25)}, {.sigma = Db{4}});
    REQUIRE(all.fixes.size() == 3);
    for (const Fix& fix : all.fixes) CHECK(*fix.error() <= 2e-3);
}

TEST_CASE("locate, fit, probe: the model `disc` is refused, because it has no levels") {
    const Propagation model = Disc{.range = 20_m};
    const auto fault = [](const auto& call) {
        try {
            call();
        } catch (const InputError& error) {
            return error.message();
        }
        return std::string();
    };
    CHECK(fault([&] { refuse_disc(model, {}, "locate"); }) ==
          "\"disc\" computes no received levels, which locate needs; expected a different "
          "propagation model");
    CHECK(fault([&] { refuse_disc(Friis{}, {}, "locate"); }).empty());
    const TemporaryFolder folder;
    const Scenario scenario =
        load_scenario(folder.write("disc.toml",
                                   "propagation = { model = \"disc\", range = \"20 m\" }\n"
                                   "robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] },\n"
                                   "  { name = \"B\", at = [\"9 m\", \"0 m\"] }]\n"),
                      {});
    CHECK(fault([&] {
              calibrate_to_model(scenario, "", {}, Db{0});
          }).find("\"disc\" computes no received levels") == 0);
    CHECK(fault([&] {
              locate_robots(scenario, {"A"}, {start_of_run}, {.sigma = Db{4}});
          }).find("\"disc\" computes no received levels") == 0);
}

TEST_CASE("locate: with shadowing the error is within 10 % of its theoretical bound") {
    const Scenario shadowed = hall("shadowing = { model = \"link\", sigma = \"2 dB\" }");
    const Located located = locate_robots(shadowed, corners, {start_of_run}, {});
    CHECK(located.sigma == Db{2});
    const auto errors = located.errors();
    REQUIRE(errors);
    CHECK(errors->fixes == 400);
    // 400 fixes: a noise of 1 / sqrt(4 * 400) = 2.5 %.
    CHECK(std::abs(errors->rms / errors->bound - 1) <= 0.1);
}

TEST_CASE(
    "locate: measured levels give positions, and also errors if the true positions are known") {
    const TemporaryFolder folder;
    const Scenario scenario = hall("");
    // Levels at (3, 4): exponent 2 is 20 dB a decade.
    const double at_1_m = 16.5321 - 40.2315;  // the default power less free space at 2450 MHz
    std::string by_place = "from_x_m,from_y_m,place,level_dbm\n",
                by_receiver = "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n";
    for (const Vec3 anchor : {Vec3{0, 0}, Vec3{10, 0}, Vec3{0, 10}}) {
        const double level = at_1_m - 20 * std::log10(std::hypot(anchor.x - 3, anchor.y - 4));
        const std::string from = std::to_string(anchor.x) + "," + std::to_string(anchor.y);
        by_place += from + ",desk," + std::to_string(level) + "\n";
        by_receiver += from + ",3,4," + std::to_string(level) + "\n";
    }
    const Located unknown =
        locate_levels(folder.write("a.csv", by_place), scenario, {.sigma = Db{4}});
    const Located known =
        locate_levels(folder.write("b.csv", by_receiver), scenario, {.sigma = Db{4}});
    REQUIRE(unknown.fixes.size() == 1);
    REQUIRE(known.fixes.size() == 1);
    CHECK(unknown.fixes[0].name == "desk");
    CHECK_FALSE(unknown.fixes[0].error());
    CHECK(std::hypot(unknown.fixes[0].found.x - 3, unknown.fixes[0].found.y - 4) < 0.01);
    CHECK(*known.fixes[0].error() < 0.01);
    CHECK(std::abs(known.fixes[0].bound->value - unknown.fixes[0].bound->value) < 0.01);
}

TEST_CASE(
    "locate: positions with too few anchors are counted; an unknown anchor and a missing sigma are "
    "errors") {
    const Scenario scenario = hall("");
    const auto fault = [&](const std::vector<std::string>& anchors,
                           const LocateQuestion& question) {
        try {
            locate_robots(scenario, anchors, {start_of_run}, question);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("none");
    };
    CHECK(fault({"SW", "SX"}, {.sigma = Db{4}}) ==
          "--anchors SX: there is no robot \"SX\" in the scenario");
    CHECK(fault(corners, {}).find("expected --sigma") != std::string::npos);
    const Located two = locate_robots(scenario, {"SW", "SE"}, {start_of_run}, {.sigma = Db{4}});
    CHECK(two.fixes.empty());
    CHECK(two.too_few == 402);
    CHECK_FALSE(two.errors());
}

}  // namespace locate_test
