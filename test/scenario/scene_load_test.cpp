// SPDX-License-Identifier: MIT
// Scenes as scenarios ask for them: materials by grey level, sidecars, heights, boxes of worlds.
#include "experiment/reports/link_report.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace scene_load_test {
using namespace rovernet;
using test::PngPicture;
using test::TemporaryFolder;

namespace {

constexpr double rounding_db = 1e-9;

bool near(double a, double b) { return std::abs(a - b) <= rounding_db; }

/// 10 x 1 pixels of 1 m: black at x = 3, grey 100 at x = 6, light grey 200 (no wall) at x = 8.
std::string picture() {
    PngPicture picture{.width = 10, .rows = {}};
    picture.rows = {{255, 255, 255, 0, 255, 255, 100, 255, 200, 255}};
    return test::png_bytes(picture);
}

const std::string pair = R"([scene]
map = "m.png"
size = ["10 m", "1 m"]
[propagation]
model = "raytrace_2007"
wall_factor = 0.2
[[robot]]
name = "a"
at = ["0.5 m", "0.5 m"]
radius = "0 m"
[[robot]]
name = "b"
at = ["9.5 m", "0.5 m"]
radius = "0 m"
)";

/// What the walls between a and b cost [dB], one way and back.
std::pair<double, double> wall_db(const std::string& file, const ScenarioOptions& options = {}) {
    const Scenario scenario = load_scenario(file, options);
    ScenarioOptions none = options;
    none.set.push_back("propagation.model=itu_indoor");
    none.set.push_back("propagation.coefficient=30");
    const Scenario without = load_scenario(file, none);
    const auto cost = [&](const char* from, const char* to) {
        return report_link(scenario, from, to, start_of_run).path_loss.value -
               report_link(without, from, to, start_of_run).path_loss.value;
    };
    return {cost("a", "b"), cost("b", "a")};
}

}  // namespace

TEST_CASE(
    "scene: dark pixels of a map are walls with the loss of `wall_factor`; light grey is free") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    const auto [there, back] = wall_db(folder.write("s.toml", pair));
    CHECK(near(there, 2 * 20));  // two metres at 0.2 dB/cm
    CHECK(there == back);
}

TEST_CASE(
    "scene: if the path of a map does not exist, a map of the same name beside the scenario is "
    "suggested") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    std::string elsewhere = pair;
    elsewhere.replace(elsewhere.find("m.png"), 5, "/home/someone/maps/m.png");
    const std::string file = folder.write("s.toml", elsewhere);
    try {
        load_scenario(file, {});
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.where().line == 2);
        CHECK(error.message() ==
              "map: there is no file \"/home/someone/maps/m.png\", but there is \"m.png\" in the "
              "same folder; write map = \"m.png\"");
    }
}

TEST_CASE("scene: keys of other programs in a ROS map give one notice each") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    folder.write("m.yaml", "image: m.png\nresolution: 1\norigin: [0, 0, 0]\nmap_type: occupancy\n");
    std::string on_ros_map = pair;
    const std::string of_picture = "map = \"m.png\"\nsize = [\"10 m\", \"1 m\"]";
    on_ros_map.replace(on_ros_map.find(of_picture), of_picture.size(), "map = \"m.yaml\"");
    const Scenario scenario = load_scenario(folder.write("s.toml", on_ros_map), {});
    const auto of_map = [](const std::string& notice) {
        return notice.ends_with(
            "m.yaml:4:1: key \"map_type\" is not a key of a map and is ignored");
    };
    CHECK(std::count_if(scenario.notices.begin(), scenario.notices.end(), of_map) == 1);
}

TEST_CASE(
    "scene: the grey level of a wall selects its material, and the material sets the wall's loss") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    const std::string file = folder.write(
        "s.toml",
        pair +
            "[scene.materials]\npartition = { greys = [90, 110], per_crossing = \"3 dB\", "
            "per_metre = \"4 dB/m\" }\nlight = { grey = 200, per_crossing = \"99 dB\" }\n");
    const auto [there, back] = wall_db(file);
    CHECK(near(there, 20 + 3 + 4));
    CHECK(there == back);
    const auto report = report_link(load_scenario(file, {}), "a", "b", start_of_run);
    CHECK(report.materials == std::vector<std::string>{"wall", "partition"});
}

TEST_CASE("scene: a wall with an ITU material has the same loss, however thick the map shows it") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    const std::string file = folder.write(
        "s.toml", pair +
                      "[scene.materials]\nall = { greys = [0, 127], itu = \"brick\", thickness = "
                      "\"0.1 m\" }\n");
    const double brick = slab_loss(ItuMaterial::brick, Meters{0.1}, Hertz{2450e6}).value;
    CHECK(near(wall_db(file).first, 2 * brick));
}

TEST_CASE(
    "scene: a file beside the map defines materials; materials of the scenario take precedence") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    folder.write("m.materials.toml",
                 "grey = { grey = 100, per_crossing = \"7 dB\" }\n"
                 "black = { grey = 0, per_crossing = \"11 dB\" }\n");
    CHECK(near(wall_db(folder.write("s.toml", pair)).first, 7 + 11));
    const std::string over =
        pair + "[scene.materials]\nmine = { grey = 0, per_crossing = \"1 dB\" }\n";
    CHECK(near(wall_db(folder.write("t.toml", over)).first, 7 + 1));
    folder.write("m.materials.toml", "grey = { gray = 100 }\n");
    CHECK_THROWS_AS(wall_db(folder.write("s.toml", pair)), InputError);
}

TEST_CASE("scene: a link between antennas above the walls crosses no wall") {
    const TemporaryFolder folder;
    folder.write("m.png", picture());
    const std::string file = folder.write("s.toml", pair);
    const ScenarioOptions low{.set = {"scene.wall_height=2 m", "radio.antenna_height=1.9 m"}};
    const ScenarioOptions high{.set = {"scene.wall_height=2 m", "radio.antenna_height=2.1 m"}};
    CHECK(near(wall_db(file, low).first, 40));
    CHECK(wall_db(file, high).first == 0);
    // From 1 m to 3.5 m over 9 m the line of sight is 2 m high at x = 4.1: past the first wall.
    const ScenarioOptions slanted{
        .set = {"scene.wall_height=2 m", "robot.b.radio.antenna_height=3.5 m"}};
    const double stretched = std::sqrt(81 + 6.25) / 9;
    CHECK(near(wall_db(file, slanted).first, 20 * stretched));
}

TEST_CASE(
    "scene: a box 0.5 m thick with wall factor 1 attenuates a link by 50 dB in both directions") {
    const TemporaryFolder folder;
    const std::string robot = "position ( name \"%\" pose [@ 0 0] wifi ( model \"raytrace\" ) )\n";
    std::string world = "model ( size [0.5 4] pose [2.5 0 0] color \"brown\" )\n";
    for (const auto& [name, x] : {std::pair{"a", "0"}, {"b", "5"}}) {
        std::string each = robot;
        each.replace(each.find('%'), 1, name);
        each.replace(each.find('@'), 1, x);
        world += each;
    }
    const double free = itu_indoor_db(5, Hertz{2450e6}, 30, 0);
    const auto cost = [&](const std::string& file, const ScenarioOptions& options = {}) {
        const Scenario scenario = load_scenario(file, options);
        const double there = report_link(scenario, "a", "b", start_of_run).path_loss.value;
        CHECK(there == report_link(scenario, "b", "a", start_of_run).path_loss.value);
        return there - free;
    };
    const std::string box = folder.write("box.world", world);
    CHECK(near(cost(box), 50));
    // Its colour can be given a material.
    const std::string file = folder.write(
        "s.toml",
        "[scene]\nworld = \"box.world\"\n[scene.materials]\nbox = { color = \"brown\", "
        "per_crossing = \"6 dB\" }\n");
    CHECK(near(cost(file), 6));
    // Only a material whose colour no wall has gives a notice, which lists the colours.
    for (const auto& [name, color, notices] : {std::tuple{"brick", "brown", 0}, {"x", "red", 1}}) {
        const Scenario scenario = load_scenario(
            folder.write("t.toml", fmt::format("[scene]\nworld = \"box.world\"\n"
                                               "[scene.materials]\n{} = {{ color = \"{}\", "
                                               "per_crossing = \"6 dB\" }}\n",
                                               name, color)),
            {});
        CHECK(std::count_if(scenario.notices.begin(), scenario.notices.end(),
                            [](const std::string& notice) {
                                return notice.ends_with("its walls have the colours brown");
                            }) == notices);
    }
    const std::string material = "scene.materials.box={color=\"brown\", per_crossing=\"6 dB\"}";
    CHECK(near(cost(box, {.set = {material}}), 6));
}

}  // namespace scene_load_test
