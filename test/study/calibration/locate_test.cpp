// SPDX-License-Identifier: MIT
// Robots in a hall with an anchor in each corner, and measured levels of the same.
#include "study/calibration/locate.hpp"

#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

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

TEST_CASE("locate: without shadowing robots are found where they are, also by a model of walls") {
    for (const char* model : {"", "propagation.model=multi_wall"}) {
        const Located located =
            locate_robots(hall("", model), corners, {start_of_run}, {.sigma = Db{4}});
        REQUIRE(located.fixes.size() == 400);
        for (const Fix& fix : located.fixes) CHECK(*fix.error() <= 2e-3);
        CHECK(located.too_few == 0);
    }
}

TEST_CASE("locate: under shadowing the error is about as large as the bound") {
    const Scenario shadowed = hall("shadowing = { model = \"link\", sigma = \"2 dB\" }");
    const Located located = locate_robots(shadowed, corners, {start_of_run}, {});
    CHECK(located.sigma == Db{2});
    const auto errors = located.errors();
    REQUIRE(errors);
    CHECK(errors->fixes == 400);
    // 400 fixes: a noise of 1 / sqrt(4 * 400) = 2.5 %.
    CHECK(std::abs(errors->rms / errors->bound - 1) <= 0.1);
}

TEST_CASE("locate: measured levels tell places, whether or not these are known") {
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

TEST_CASE("locate: what cannot be located is told, and why") {
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
    CHECK(fault({"SW", "SX"}, {.sigma = Db{4}}) == "--anchors SX: no robot SX");
    CHECK(fault(corners, {}).find("expected --sigma") != std::string::npos);
    const Located two = locate_robots(scenario, {"SW", "SE"}, {start_of_run}, {.sigma = Db{4}});
    CHECK(two.fixes.empty());
    CHECK(two.too_few == 402);
    CHECK_FALSE(two.errors());
}

}  // namespace locate_test
