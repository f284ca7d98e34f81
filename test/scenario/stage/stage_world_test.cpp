// SPDX-License-Identifier: MIT
#include "scenario/stage/stage_world.hpp"

#include "models/link_gain.hpp"
#include "models/radio.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scene/scene.hpp"
#include "scene/stage/stage_walls.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stage_world_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

/// What a world comes to, with its notices; their folder is left out.
struct Read {
    Table document;
    std::vector<std::string> notices;

    const Array& robots() const {
        static const Array none;
        const Value* list = document.find("robot");
        return list ? *list->array() : none;
    }
    const Table& robot(std::size_t i) const { return *robots().at(i).table(); }
    const Table& radio(std::size_t i) const { return *robot(i).find("radio")->table(); }
    const Table& propagation(std::size_t i) const { return *robot(i).find("propagation")->table(); }
};

Read read(const std::string& text) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.world", text);
    const WorldFile world = read_worldfile(path, {});
    Read out;
    out.document = stage_document(world, out.notices);
    for (auto& notice : out.notices) {
        const std::string place = folder.path("");
        for (auto at = notice.find(place); at != notice.npos; at = notice.find(place)) {
            notice.erase(at, place.size());
        }
    }
    return out;
}

std::string mistake(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) +
               ": " + error.message();
    }
    return "";
}

/// A value as text, "none" if it is not there; numbers with their decimals.
std::string value(const Table& table, const std::string& key) {
    const Value* found = table.find(key);
    if (!found) return "none";
    if (const auto* text = found->string()) return *text;
    if (const auto* list = found->array()) {
        std::string all;
        for (const auto& item : *list) all += (all.empty() ? "" : ", ") + *item.string();
        return all;
    }
    const std::string text = found->description();
    return text.substr(text.find_last_of(' ') + 1);
}

const std::string robot_with = "position ( name \"a\" pose [1 2 30] size [0.25 0.5] wifi ( ";

/// The folder of the worlds that came with Stage, if the environment names it.
std::optional<std::string> stage_worlds() {
    const char* folder = std::getenv("ROVERNET_WORLDS");
    if (folder) return std::string(folder);
    MESSAGE("skipped: ROVERNET_WORLDS is not set");
    return std::nullopt;
}

WorldOptions with_includes(const std::string& folder) {
    return {.search_path = {folder + "/stage-include", folder + "/stage-wifi"}};
}

Read read_shipped(const std::string& folder, const std::string& name) {
    Read out;
    const WorldFile world = read_worldfile(folder + "/stage-wifi/" + name, with_includes(folder));
    out.document = stage_document(world, out.notices);
    return out;
}

/// Received power of `to` from `from` [dBm], by the document's own radios, places and model.
double level(const Read& world, std::size_t from, std::size_t to, const Scene& scene = {}) {
    const auto place = [&](std::size_t i) {
        const Array& at = *world.robot(i).find("at")->array();
        return Vec3{read_quantity(at[0], "at", Dimension::length),
                    read_quantity(at[1], "at", Dimension::length), 1};
    };
    const auto radio = [&](std::size_t i) {
        Radio made;
        if (const Value* power = world.radio(i).find("power")) {
            made.power = Dbm{read_quantity(*power, "power", Dimension::power)};
        }
        return made;
    };
    const Radio sender = radio(from);
    const std::array<Vec3, 1> receivers{place(to)};
    const std::array<std::uint64_t, 1> keys{2};
    const LinkBatch link{.frequency = sender.frequency,
                         .from = place(from),
                         .to = receivers,
                         .from_key = 1,
                         .to_keys = keys,
                         .scene = &scene};
    double loss = 0;
    median_propagation(Value(world.propagation(from)))
        .loss(link, Db{std::numeric_limits<double>::infinity()}, std::span(&loss, 1));
    return received_power(sender, radio(to), Db{loss}).value;
}

/// 32.447783 dB, exact, against the 32.44177 dB of the 2007 device.
constexpr double friis_constant = 0.0060;
/// The published levels have four decimals; the constant above has four, too.
constexpr double level_tolerance = 1e-3;  // [dB]

}  // namespace

TEST_CASE(
    "stage world: a `position` with a `wifi` becomes a robot with the same pose, size and radio") {
    const Read world = read(robot_with +
                            "ip \"192.168.0.2\" netmask \"255.255.0.0\" mac \"08-00-20-ae-fd-7e\" "
                            "essid \"net\" model \"friis\" power 30 freq 2412.5 sensitivity -80 "
                            "range_db -50 link_success_rate 50 ) )\n");
    REQUIRE(world.robots().size() == 1);
    const Table& robot = world.robot(0);
    CHECK(value(robot, "name") == "a");
    CHECK(value(robot, "at") == "1 m, 2 m");
    CHECK(value(robot, "heading") == "30 deg");
    CHECK(read_quantity(*robot.find("radius"), "radius", Dimension::length) == 0.125);
    const Table& radio = world.radio(0);
    CHECK(value(radio, "ip") == "192.168.0.2");
    CHECK(value(radio, "netmask") == "255.255.0.0");
    CHECK(value(radio, "mac") == "08-00-20-ae-fd-7e");
    CHECK(value(radio, "essid") == "net");
    CHECK(value(radio, "power") == "30 mW");
    CHECK(value(radio, "frequency") == "2412.5 MHz");
    CHECK(value(radio, "sensitivity") == "-80 dBm");
    CHECK(value(radio, "range_db") == "-50 dBm");
    CHECK(std::get<double>(radio.find("success_rate")->data) == 51.0 / 101);
    CHECK(value(world.propagation(0), "model") == "friis");
    CHECK(world.notices.empty());
    CHECK(world.document.find("scenario") == nullptr);
}

TEST_CASE("stage world: the scenario made from a world contains only values that the world sets") {
    const Read world = read(robot_with + "model \"friis\" ) )\n");
    CHECK(world.radio(0).entries.empty());
    CHECK(world.propagation(0).entries.size() == 1);
}

TEST_CASE(
    "stage world: the five propagation models of Stage become models of rovernet, with their "
    "parameters") {
    struct Row {
        std::string stage, model, key, expected;
    };
    for (const Row& row : {
             Row{"model \"friis\"", "friis", "coefficient", "none"},
             Row{"model \"ITU indoor\" plc 22.5", "itu_indoor", "coefficient", "22.5"},
             Row{"model \"log distance\" ple 4", "log_distance", "exponent", "4.0"},
             Row{"model \"log distance\" sigma 3.5", "log_distance", "sigma", "3.5 dB"},
             Row{"model \"raytrace\" wall_factor 10", "raytrace_2007", "wall_factor", "10.0"},
             Row{"model \"raytrace\" plc 28", "raytrace_2007", "coefficient", "28.0"},
             Row{"model \"simple\" range 3.5", "disc", "range", "3.5 m"},
             Row{"model \"friis\" range 6", "friis", "range", "6 m"},
             Row{"model \"friis\" plc 30 ple 3 sigma 2 wall_factor 1", "friis", "exponent", "3.0"},
         }) {
        CAPTURE(row.stage);
        const Read world = read(robot_with + row.stage + " ) )\n");
        CHECK(value(world.propagation(0), "model") == row.model);
        CHECK(value(world.propagation(0), row.key) == row.expected);
        CHECK(world.notices.empty());
        CHECK_NOTHROW(median_propagation(*world.robot(0).find("propagation")));
    }
}

TEST_CASE(
    "stage world: a wifi without a propagation model uses the model of [propagation]; an unknown "
    "model is an error") {
    const Read none =
        read("position ( name \"a\" wifi ( ) )\nposition ( name \"b\"\nwifi ( plc 22 ) )\n");
    CHECK(none.robot(0).find("propagation") == nullptr);
    CHECK(none.propagation(1).entries.size() == 1);
    CHECK(value(none.propagation(1), "coefficient") == "22.0");
    REQUIRE(none.notices.size() == 1);
    CHECK(none.notices[0] ==
          "a.world:1: the wifi of these robots has no model, so the model of [propagation] is used "
          "(default: friis): a, b");
    CHECK(mistake(robot_with + "\nmodel \"ITU Indoor\" ) )\n") ==
          "2:1: model: found \"ITU Indoor\"; expected one of \"friis\", \"ITU indoor\", \"log "
          "distance\", \"raytrace\", \"simple\"; did you mean \"ITU indoor\"?");
    CHECK(mistake(robot_with + "\nmodel \"x\" ) )\n").ends_with("write model \"friis\""));
    const Read simple = read(robot_with + "model \"simple\" ) )\n");
    CHECK(value(simple.propagation(0), "range") == "0 m");
    REQUIRE(simple.notices.size() == 1);
    CHECK(simple.notices[0] ==
          "a.world:1: a wifi of model \"simple\" without a range has the range 0 m, as in Stage; "
          "to connect robots, give this wifi a range");
}

TEST_CASE(
    "stage world: the key `freq` sets the frequency, or the key `frequency` if `freq` is missing") {
    const std::string friis = "model \"friis\" ";
    CHECK(value(read(robot_with + friis + "frequency 900 ) )").radio(0), "frequency") == "900 MHz");
    CHECK(value(read(robot_with + friis + "freq 5200 frequency 900 ) )").radio(0), "frequency") ==
          "5200 MHz");
}

TEST_CASE("stage world: link_success_rate r becomes (r + 1) / 101, as Stage draws from 0 to 100") {
    const auto rate = [](const std::string& given) {
        const Read world = read(robot_with + "model \"friis\" link_success_rate " + given + " ) )");
        return std::get<double>(world.radio(0).find("success_rate")->data);
    };
    CHECK(rate("100") == 1);
    CHECK(rate("0") == 1.0 / 101);
    CHECK(rate("-1") == 0);
    CHECK(rate("-7") == 0);
    CHECK(rate("500") == 1);
}

TEST_CASE(
    "stage world: the last random_seed becomes the scenario's seed, and quit_time its duration") {
    const Read world = read(
        "quit_time 90.5\n"
        "position ( name \"a\" wifi ( model \"friis\" random_seed 7 ) )\n"
        "position ( name \"b\" wifi ( model \"friis\" random_seed 8 ) )\n"
        "position ( name \"c\" wifi ( model \"friis\" ) )\n");
    const Table& scenario = *world.document.find("scenario")->table();
    CHECK(value(scenario, "duration") == "90.5 s");
    CHECK(value(scenario, "seed") == "8");
    CHECK(scenario.find("seed")->where.line == 3);
    CHECK(read("quit_time 0\n").document.find("scenario") == nullptr);
    CHECK(mistake(robot_with + "random_seed 1.5 ) )")
              .starts_with("1:58: random_seed: found 1.5; expected a whole number"));
    CHECK(mistake(robot_with + "random_seed -1 ) )").starts_with("1:58: random_seed: found -1;"));
}

TEST_CASE("stage world: poses of four numbers, unit_length and unit_angle of Stage 4 are read") {
    const Read world = read(
        "unit_length \"cm\" unit_angle \"radians\"\n"
        "position ( name \"a\" pose [100 200 30 3.141592653589793] size [30 20 50]\n"
        "  wifi ( model \"simple\" range 250 ) )\n");
    CHECK(value(world.robot(0), "at") == "1 m, 2 m");
    CHECK(value(world.robot(0), "heading") == "180 deg");
    CHECK(read_quantity(*world.robot(0).find("radius"), "radius", Dimension::length) == 0.1);
    CHECK(value(world.propagation(0), "range") == "2.5 m");
    REQUIRE(world.notices.size() == 1);
    CHECK(world.notices[0] ==
          "a.world:2: the height z of these robots is ignored, as in the original wifi model for "
          "Stage: a");
}

TEST_CASE("stage world: a robot that is part of another model has the combined pose of both") {
    const Read world = read(
        "model ( pose [10 0 90] position ( name \"a\" pose [2 0 0]\n"
        "  wifi ( model \"friis\" )\n"
        "  model ( wifi ( model \"simple\" ) position ( name \"b\" pose [0 1 -30] wifi ( model "
        "\"friis\" ) ) ) ) )\n");
    REQUIRE(world.robots().size() == 2);
    CHECK(value(world.robot(0), "name") == "a");
    CHECK(value(world.robot(0), "at") == "10 m, 2 m");
    CHECK(value(world.robot(0), "heading") == "90 deg");
    CHECK(value(world.propagation(0), "model") == "friis");
    CHECK(value(world.robot(1), "name") == "b");
    CHECK(value(world.robot(1), "at") == "9 m, 2 m");
    CHECK(value(world.robot(1), "heading") == "60 deg");
    REQUIRE(world.notices.size() == 1);
    CHECK(world.notices[0] == "a.world:1: only the first wifi of these robots is used: a");
}

TEST_CASE(
    "stage world: if a robot carries another robot with a wifi, only the carried robot has this "
    "wifi") {
    const Read world = read(
        "position ( name \"truck\" pose [5 0 180]\n"
        "  position ( name \"a\" pose [1 0 0] wifi ( model \"friis\" ) ) )\n");
    REQUIRE(world.robots().size() == 2);
    CHECK(value(world.robot(0), "name") == "truck");
    CHECK(world.robot(0).find("radio") == nullptr);
    CHECK(value(world.robot(1), "name") == "a");
    CHECK(value(world.robot(1), "at") == "4 m, 0 m");
    CHECK(value(world.propagation(1), "model") == "friis");
    REQUIRE(world.notices.size() == 1);
    CHECK(world.notices[0] ==
          "a.world:1: robots without a wifi get the radio of [radio] and the model of "
          "[propagation] (default: friis): truck");
}

TEST_CASE("stage world: robots without a wifi have the scenario's radio, with one notice for all") {
    const TemporaryFolder folder;
    folder.write("hall.world",
                 "define rover position ( size [0.5 0.4 0.2] laser ( samples 9 ) )\n"
                 "model ( size [10 6 1] boundary 1 noblocks 1 )\n"
                 "rover ( name \"r0\" pose [-3 1 0 90] )\nrover ( pose [3 1 0 180] )\n");
    const Scenario alone = load_scenario(folder.path("hall.world"), {});
    REQUIRE(alone.robots.size() == 2);
    CHECK(alone.robots[0].radio.power.value == Radio{}.power.value);
    CHECK(!alone.robots[0].propagation);
    CHECK(alone.robots[0].scan.size() == 1);
    const auto about_radio = std::count_if(
        alone.notices.begin(), alone.notices.end(),
        [](const std::string& n) { return n.find("get the radio of [radio]") != n.npos; });
    CHECK(about_radio == 1);

    const Scenario over = load_scenario(
        folder.write("s.toml",
                     "[scene]\nworld = \"hall.world\"\n[radio]\npower = \"3 dBm\"\n"
                     "[[robot]]\nname = \"r0\"\nradio = { sensitivity = \"-60 dBm\" }\n"),
        {});
    REQUIRE(over.robots.size() == 2);
    const RobotTable& r0 = over.robots[0];
    CHECK(r0.at == Vec3{-3, 1, 0});
    CHECK(r0.radius.value == 0.2);
    CHECK(r0.scan.size() == 1);
    CHECK(r0.radio.power.value == 3);
    CHECK(r0.radio.sensitivity.value == -60);
    CHECK(over.robots[1].radio.sensitivity.value == -75);
}

TEST_CASE("stage world: a world without robots can be loaded as a scene, but not as a scenario") {
    const TemporaryFolder folder;
    const std::string world = folder.write("plan.world", "model ( size [4 2 1] )\n");
    const Scenario scene = load_scenario(world, {.needs_robots = false});
    CHECK(scene.robots.empty());
    CHECK(scene.walls);
    CHECK_THROWS_WITH_AS(
        load_scenario(world, {}),
        doctest::Contains("found no robot in this world; expected a model of type position"),
        InputError);
}

TEST_CASE("stage world: the error about a world without robots lists what was ignored") {
    const TemporaryFolder folder;
    const std::string world = folder.write("p.world", "include \"r.inc\"\nscout ( name \"x\" )\n");
    CHECK_THROWS_WITH_AS(load_scenario(world, {.lenient = true}),
                         doctest::Contains("\"r.inc\" is missing, so it is left out"), InputError);
    CHECK_THROWS_WITH_AS(load_scenario(world, {.lenient = true}),
                         doctest::Contains("unknown type \"scout\""), InputError);
}

TEST_CASE("stage world: --set and varied values may choose the world") {
    const TemporaryFolder folder;
    folder.write("a.world", "position ( name \"a\" wifi ( ) )\n");
    folder.write("b.world", "position ( name \"b\" wifi ( ) )\nposition ( name \"c\" )\n");
    const std::string path = folder.write("s.toml", "[scene]\nworld = \"a.world\"\n");
    CHECK(load_scenario(path, {}).robots.at(0).name == "a");
    for (const std::string set :
         {"scene.world=b.world", "\"scene\".world=b.world", "scene={ world = \"b.world\" }"}) {
        CAPTURE(set);
        const Scenario b = load_scenario(path, {.set = {set}});
        REQUIRE(b.robots.size() == 2);
        CHECK(b.robots[0].name == "b");
    }

    // Options about robots hold for the robots of the chosen world.
    const ScenarioFile file(path, {.set = {"robot.0.radius=0.3"}});
    Table chosen;
    chosen.set("scene.world", "b.world");
    chosen.set("robot.c.radius", "0.4 m");
    const Scenario b = file.scenario(chosen);
    REQUIRE(b.robots.size() == 2);
    CHECK(b.robots[0].name == "b");
    CHECK(b.robots[0].radius.value == 0.3);
    CHECK(b.robots[1].radius.value == 0.4);
    CHECK(file.scenario().robots.size() == 1);
}

TEST_CASE("stage world: a [[robot]] without a place must be a robot of the world") {
    const TemporaryFolder folder;
    folder.write("a.world", "position ( name \"base\" wifi ( ) )\n");
    const auto load = [&](const std::string& name) {
        return load_scenario(folder.write("a.toml",
                                          "[scene]\nworld = \"a.world\"\n[[robot]]\n"
                                          "name = \"" +
                                              name + "\"\nradius = \"0.2 m\"\n"),
                             {});
    };
    CHECK(load("base").robots.at(0).radius.value == 0.2);
    CHECK_THROWS_WITH_AS(load("bsae"), doctest::Contains("a.toml:4:8: name: no world and no"),
                         InputError);
    CHECK_THROWS_WITH_AS(load("bsae"), doctest::Contains("did you mean \"base\"?"), InputError);
    const std::string moved =
        "bsae\"\nmove = { model = \"waypoints\", path = [[\"1 m\", \"1 m\"]] }\nrole = \"";
    CHECK_THROWS_WITH_AS(load(moved), doctest::Contains("did you mean \"base\"?"), InputError);
    CHECK_THROWS_WITH_AS(load("base\"\n[[robot]]\nname = \"base"),
                         doctest::Contains("a.toml:5:1: a second [[robot]] is named \"base\""),
                         InputError);
}

TEST_CASE("stage world: a model whose macro is missing becomes a robot if the model has a wifi") {
    const Read world = read("pioneer ( name \"a\" cargo ( wifi ( model \"friis\" ) ) )\n");
    REQUIRE(world.robots().size() == 1);
    CHECK(value(world.propagation(0), "model") == "friis");
    CHECK(world.notices.back() == "a.world: models of these types are ignored: cargo (1)");
}

TEST_CASE(
    "stage world: a wifi nested at any depth in a position model belongs to the robot of this "
    "position") {
    const Read world = read("position ( name \"a\" ranger ( model ( wifi ( power 3 ) ) ) )\n");
    REQUIRE(world.robots().size() == 1);
    CHECK(value(world.radio(0), "power") == "3 mW");
}

TEST_CASE("stage world: the scenario made from a world is read with all values of the world") {
    const Read world = read(
        "quit_time 20\n" + robot_with +
        "ip \"1.2\" netmask \"255.0.0.0\" mac \"m\" essid \"net\" model \"raytrace\" plc 28\n"
        "wall_factor 10 ple 3 sigma 2 range 4 power 100 freq 2400 sensitivity -80 range_db -50\n"
        "link_success_rate 49 random_seed 5 ) )\nposition ( pose [0 0 -90] wifi ( ) )\n");
    const Scenario scenario = read_scenario(Value(world.document), "a.world");
    CHECK(scenario.scenario.duration == std::chrono::seconds{20});
    CHECK(scenario.scenario.seed == 5);
    REQUIRE(scenario.robots.size() == 2);
    const RobotTable& robot = scenario.robots[0];
    CHECK(robot.at == Vec3{1, 2, 0});
    CHECK(robot.radius.value == 0.125);
    CHECK(robot.radio.power.value == 20);
    CHECK(robot.radio.frequency.value == 2400e6);
    CHECK(robot.radio.sensitivity.value == -80);
    CHECK(robot.radio.labels.ip == "1.2");
    CHECK(robot.radio.labels.range_db->value == -50);
    CHECK(robot.radio.success_rate == 50.0 / 101);
    const auto& parameters = robot.propagation->parameters;
    CHECK(std::get<Raytrace2007>(parameters).coefficient == 28);
    CHECK(std::get<Raytrace2007>(parameters).wall_factor == 10);
    CHECK(std::get<LogDistance>(parameters).exponent == 3);
    CHECK(std::get<LogDistance>(parameters).sigma.value == 2);
    CHECK(std::get<Disc>(parameters).range.value == 4);
    CHECK(!scenario.robots[1].propagation);
    CHECK(scenario.robots[1].radio.power.value == Radio{}.power.value);
}

TEST_CASE("stage world: every value of the scenario has its line and column in the world file") {
    const Read world =
        read("position\n(\n pose [1 2 3]\n wifi (\n  model \"friis\"\n  power 30\n )\n)");
    CHECK(world.robots()[0].where.line == 1);
    CHECK(world.robot(0).find("name")->where.line == 1);
    CHECK(world.robot(0).find("at")->where.line == 3);
    CHECK(world.robot(0).find("at")->array()->at(1).where.line == 3);
    CHECK(world.robot(0).find("heading")->where.line == 3);
    CHECK(world.robot(0).find("radius")->where.line == 1);
    CHECK(world.robot(0).find("radio")->where.line == 4);
    CHECK(world.robot(0).find("propagation")->where.line == 4);
    CHECK(world.propagation(0).find("model")->where.line == 5);
    CHECK(world.radio(0).find("power")->where.line == 6);
    CHECK(world.radio(0).find("power")->where.column == 3);
}

TEST_CASE("stage world: robots without a name get names that no other robot has") {
    const Read world = read(
        "define bot position ( wifi ( model \"friis\" ) )\n"
        "bot ( )\nbot ( name \"robot2\" )\nbot ( )\nbot ( )\n");
    CHECK(value(world.robot(0), "name") == "robot0");
    CHECK(value(world.robot(1), "name") == "robot2");
    CHECK(value(world.robot(2), "name") == "robot2_");
    CHECK(value(world.robot(3), "name") == "robot3");
    REQUIRE(world.notices.size() == 1);
    CHECK(world.notices[0] ==
          "a.world:2: names are generated for robots without a name: robot0, robot2_, robot3");
}

TEST_CASE("stage world: a second robot with the same name gets a new name, with a notice") {
    const Read world = read(
        "define bot position ( wifi ( model \"friis\" ) )\n"
        "bot ( name \"a\" )\nbot ( name \"a_\" )\nmodel ( name \"a\" )\n"
        "bot ( name \"a\" )\nbot ( name \"a\" )\nbot ( )\n");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < world.robots().size(); ++i) {
        names.push_back(value(world.robot(i), "name"));
    }
    CHECK(names == std::vector<std::string>{"a", "a_", "a__", "a___", "robot4"});
    CHECK(world.notices.back() ==
          "a.world:5: new names are generated for robots whose name is already in use: a__, a___");
}

TEST_CASE("stage world: if two robots have the same address, a notice names both robots") {
    const Read world = read(
        "define bot position ( wifi ( model \"friis\" ) )\n"
        "bot ( name \"a\" wifi ( ip \"1.2\" mac \"x\" ) )\n");
    CHECK(world.notices.size() == 1);  // the macro's wifi comes first
    const Read twice = read(
        "position ( name \"a\" wifi ( model \"friis\" ip \"1.2\" mac \"1.2\" ) )\n"
        "position ( name \"b\" wifi ( model \"friis\" ip \"1.2\" mac \"1.3\" ) )\n");
    REQUIRE(twice.notices.size() == 1);
    CHECK(twice.notices[0] ==
          "a.world:2: the ip \"1.2\" of robot \"b\" is also used by robot \"a\" (a.world:1:42); "
          "give each robot a different address");
}

TEST_CASE("stage world: one notice lists all types of models that are neither robots nor walls") {
    const Read world = read(
        "window ( )\nmodel ( laser ( ) )\n"
        "position ( name \"a\" laser ( ) ranger ( sensor ( ) ) wifi ( model \"friis\" ) )\n"
        "position ( name \"b\" laser ( ) )\nposition ( )\nwifi ( )\n");
    CHECK(world.robots().size() == 3);
    REQUIRE(world.notices.size() == 4);
    CHECK(world.notices[1] ==
          "a.world:4: robots without a wifi get the radio of [radio] and the model of "
          "[propagation] (default: friis): b, robot2");
    CHECK(world.notices[2] ==
          "a.world:6: a wifi that belongs to no model of type position is ignored: wifi");
    CHECK(world.notices[3] == "a.world: models of these types are ignored: laser (1), window (1)");
}

TEST_CASE(
    "stage world: each unknown key of a wifi gives a notice; unknown keys of other models give "
    "none") {
    const Read world =
        read(robot_with + "model \"friis\" size [0 0]\nrange3 -35\nsensitivty -80\nwatts 2 ) )\n");
    REQUIRE(world.notices.size() == 2);
    CHECK(
        world.notices[0] ==
        "a.world:2: a wifi has no key \"range3\", so this key is ignored; did you mean \"range\"?");
    CHECK(world.notices[1] ==
          "a.world:3: a wifi has no key \"sensitivty\", so this key is ignored; did you mean "
          "\"sensitivity\"?");
}

TEST_CASE("stage world: values of a wrong type are refused, with line and column") {
    CHECK(mistake(robot_with + "ip 5 ) )") ==
          "1:58: ip: found a number; expected a text in quotes; write ip \"...\"");
    CHECK(mistake(robot_with + "power \"30\" ) )") ==
          "1:58: power: found a text; expected one number; write power 30");
    CHECK(
        mistake(robot_with + "power [30] ) )").starts_with("1:58: power: found a list; expected"));
    CHECK(mistake("position ( name 5 wifi ( ) )").starts_with("1:12: name: found a number"));
    CHECK(mistake("quit_time \"1\"\n").starts_with("1:1: quit_time: found a text"));
}

TEST_CASE("stage world: a world file in the style of the 2007 thesis is read without changes") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("lib"));
    folder.write("lib/robots.inc",
                 "define sonars ranger ( scount 2 spose[0] [0.1 0.1 90] spose[1] [0.1 -0.1 -90] )\n"
                 "define pioneer2dx position ( size [0.44 0.33] origin [-0.04 0 0] polygons 1\n"
                 "  polygon[0].points 3 polygon[0].point[0] [1 0] polygon[0].point[1] [0 1]\n"
                 "  polygon[0].point[2] [0 0] drive \"diff\" sonars ( ) )\n");
    folder.write("lib/map.inc", "define map model ( color \"black\" boundary 1 gui_nose 0 )\n");
    folder.write("rooms.pgm", "P2\n3 1\n255\n0 255 0\n");
    const std::string path = folder.write("a.world",
                                          "include \"robots.inc\"\ninclude \"map.inc\"\n"
                                          "interval_sim 100 # ms\ninterval_real 100\n"
                                          "gui_interval 20\nresolution 0.02\nsize [30 10]\n"
                                          "window\n(\n size [ 600.000 400.000 ]\n center [0 0]\n"
                                          " scale 0.05\n)\n"
                                          "map\n(\n bitmap \"rooms.pgm\"\n size [30 10]\n"
                                          " name \"rooms\"\n)\n"
                                          "pioneer2dx\n(\n name \"left\"\n pose [-5 0 45]\n"
                                          " laser()\n wifi(\n  ip \"192.168.0.1\"\n"
                                          "  mac \"00-11-22-33-44-55\"\n  model \"raytrace\"\n"
                                          "  frequency 2437\n  power 31.5\n )\n)\n");
    const WorldOptions options{.search_path = {folder.path("lib")}};
    const WorldFile world = read_worldfile(path, options);
    CHECK(world.notices.empty());
    Read out;
    out.document = stage_document(world, out.notices);
    REQUIRE(out.robots().size() == 1);
    CHECK(value(out.robot(0), "name") == "left");
    CHECK(value(out.radio(0), "mac") == "00-11-22-33-44-55");
    CHECK(value(out.radio(0), "frequency") == "2437 MHz");
    CHECK(value(out.propagation(0), "model") == "raytrace_2007");
    CHECK(read_quantity(*out.robot(0).find("radius"), "radius", Dimension::length) == 0.165);
    REQUIRE(out.notices.size() == 1);
    CHECK(out.notices[0] == path + ": models of these types are ignored: window (1)");
    const StageWalls walls = stage_walls(world, options);
    CHECK(walls.notices.empty());
    REQUIRE(walls.grids.size() == 5);  // the picture and its boundary
    CHECK(walls.grids[0].columns == 3);
    CHECK(walls.grids[0].cell_width == 10);
    REQUIRE(walls.materials.size() == 1);
    CHECK(walls.materials[0].name == "black");
}

TEST_CASE("stage world: the worlds that came with Stage can be loaded") {
    const auto folder = stage_worlds();
    if (!folder) return;
    struct Row {
        std::string name;
        std::size_t robots, grids;
    };
    for (const Row& row :
         {Row{"wifi.world", 3, 5}, Row{"wifi_itu.world", 3, 0}, Row{"wifi_simple.world", 3, 5},
          Row{"hosp_wifi.world", 2, 5}, Row{"commando.world", 2, 5}}) {
        CAPTURE(row.name);
        const Read world = read_shipped(*folder, row.name);
        CHECK(world.robots().size() == row.robots);
        const WorldOptions options = with_includes(*folder);
        const WorldFile file = read_worldfile(*folder + "/stage-wifi/" + row.name, options);
        CHECK(file.notices.empty());
        CHECK(stage_walls(file, options).grids.size() == row.grids);
    }
    const Read commando = read_shipped(*folder, "commando.world");
    REQUIRE(commando.notices.size() == 2);
    CHECK(commando.notices[0].find("commando.world:53: the mac \"00:03:03:ac:a7:b5\" of robot "
                                   "\"robot2\" is also used by robot \"robot1\"") !=
          std::string::npos);
}

TEST_CASE(
    "stage world: a world whose bitmap is missing is refused, unless a replacement is given") {
    const auto folder = stage_worlds();
    if (!folder) return;
    WorldOptions options = with_includes(*folder);
    const WorldFile world = read_worldfile(*folder + "/stage-wifi/wifi_ray.world", options);
    CHECK_THROWS_WITH_AS(
        stage_walls(world, options),
        doctest::Contains(
            "wifi_ray.world:22:3: bitmap: no file \"bitmaps/cave_f.png\"; tried the paths "),
        InputError);
    options.bitmaps = {{"cave_f.png", "cave_filled.png"}};
    const StageWalls walls = stage_walls(world, options);
    REQUIRE(!walls.grids.empty());
    CHECK(walls.grids[0].columns == 500);
    Read read;
    read.document = stage_document(world, read.notices);
    // The line of sight is clear: the published level is that of the ITU formula alone.
    const Scene scene(walls.grids[0]);
    CHECK(std::abs(level(read, 0, 1, scene) + 39.9603) < level_tolerance);
    CHECK(std::abs(level(read, 1, 0, scene) + 39.9603) < level_tolerance);
    REQUIRE(read.notices.size() == 3);
    CHECK(read.notices[0].find("a wifi has no key \"range3\"") != std::string::npos);
}

TEST_CASE(
    "stage world: signal levels in the worlds that came with Stage equal the published levels") {
    const auto folder = stage_worlds();
    if (!folder) return;
    struct Row {
        std::size_t from, to;
        double level;
    };
    const Read friis = read_shipped(*folder, "wifi.world");
    for (const Row& row : {Row{0, 1, -39.4333}, Row{1, 0, -38.1839}, Row{0, 2, -50.7430},
                           Row{2, 0, -49.4937}, Row{1, 2, -46.7813}, Row{2, 1, -46.7813}}) {
        CAPTURE(row.level);
        CHECK(std::abs(level(friis, row.from, row.to) + friis_constant - row.level) <
              level_tolerance);
    }
    const Read itu = read_shipped(*folder, "wifi_itu.world");
    for (const Row& row : {Row{0, 1, -45.9812}, Row{1, 0, -45.7009}, Row{0, 2, -62.9459},
                           Row{2, 0, -62.8035}, Row{1, 2, -58.5970}, Row{2, 1, -58.7349}}) {
        CAPTURE(row.level);
        CHECK(std::abs(level(itu, row.from, row.to) - row.level) < level_tolerance);
    }
}

}  // namespace stage_world_test
