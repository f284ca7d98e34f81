// SPDX-License-Identifier: MIT
// Lasers and rangers of Stage worlds, as range finders of the robots that carry them.
#include "scenario/stage/stage_scanner.hpp"

#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/stage/stage_world.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace stage_scanner_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

constexpr double degrees = std::numbers::pi / 180;  // [rad]
constexpr double exact = 1e-9;                      // [rad, m]

bool near(double a, double b) { return std::abs(a - b) < exact; }
bool near(Radians a, double b) { return near(a.value, b); }

/// Robots of a world, and its notices without their folder.
struct Read {
    std::vector<RobotTable> robots;
    std::vector<std::string> notices;

    const std::vector<Scanner>& scan() const { return robots.at(0).scan; }
    const Scanner& only() const {
        REQUIRE(scan().size() == 1);
        return scan()[0];
    }
};

Read read(const std::string& text) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.world", text);
    const WorldFile world = read_worldfile(path, {});
    Read out;
    const Table document = stage_document(world, out.notices);
    out.robots = read_scenario(Value(document), path).robots;
    for (auto& notice : out.notices) notice.erase(0, folder.path("").size());
    return out;
}

/// A robot that carries something.
Read carrying(const std::string& parts) {
    return read("position ( name \"a\" wifi ( model \"friis\" )\n" + parts + " )\n");
}

std::string mistake(const std::string& parts) {
    try {
        carrying(parts);
    } catch (const InputError& error) {
        return std::to_string(error.where().line) + ": " + error.message();
    }
    return "";
}

}  // namespace

TEST_CASE("stage scanner: a laser has Stage's defaults, 180 samples over 180 degrees up to 8 m") {
    const Read world = carrying("laser ( )");
    CHECK(world.notices.empty());
    const Scanner& laser = world.only();
    CHECK(laser.finder.kind == RangeFinderKind::laser);
    CHECK(laser.finder.beams == 180);
    CHECK(near(laser.finder.from, -90 * degrees));
    CHECK(near(laser.finder.to, 90 * degrees));
    CHECK(laser.finder.range.value == 8);
    CHECK(laser.finder.every == RangeFinder{}.every);
    CHECK(laser.at == Vec3{});
    CHECK(laser.heading.value == 0);
    CHECK(laser.name.empty());
}

TEST_CASE("stage scanner: keys of a laser are read in the units of the world") {
    const Read world = read(
        "unit_length \"cm\" unit_angle \"radians\"\n"
        "define sick laser ( samples 91 range_max 1250 range_min 3 fov 3 color \"blue\" )\n"
        "position ( name \"a\" wifi ( model \"friis\" )\n"
        "  sick ( samples 31 pose [20 -10 0.5] update_interval 250 ) )\n");
    CHECK(world.notices.empty());
    const Scanner& laser = world.only();
    CHECK(laser.finder.beams == 31);
    CHECK(near(laser.finder.from, -1.5));
    CHECK(near(laser.finder.to, 1.5));
    CHECK(laser.finder.range.value == 12.5);
    CHECK(laser.finder.every == std::chrono::milliseconds(250));
    CHECK(laser.at == Vec3{0.2, -0.1});
    CHECK(near(laser.heading, 0.5));
    const Scanner one = carrying("laser ( samples 1 fov 90 )").only();
    CHECK(one.finder.from.value == 0);
    CHECK(one.finder.to.value == 0);
}

TEST_CASE(
    "stage scanner: if a laser is mounted on a part of the robot, the poses of laser and part are "
    "combined") {
    const Read world = carrying("model ( pose [0.2 0 0 90] laser ( pose [0.1 0 0 45] ) )");
    CHECK(near(world.only().at.x, 0.2));
    CHECK(near(world.only().at.y, 0.1));
    CHECK(near(world.only().heading, 135 * degrees));
}

TEST_CASE("stage scanner: a ranger of Stage 4 with one sensor becomes a fan of beams") {
    const Read world = carrying(
        "ranger ( pose [0.1 0 0.2 90] sensor ( pose [0.05 0 0 10] size [0.1 0.1 0.1]\n"
        " range [0.5 4.5] fov 270 samples 271 ) )");
    CHECK(world.notices.empty());
    const Scanner& ranger = world.only();
    CHECK(ranger.finder.kind == RangeFinderKind::ranger);
    CHECK(ranger.finder.beams == 271);
    CHECK(near(ranger.finder.from, -135 * degrees));
    CHECK(near(ranger.finder.to, 135 * degrees));
    CHECK(ranger.finder.range.value == 4.5);
    CHECK(near(ranger.at.x, 0.1));
    CHECK(near(ranger.at.y, 0.05));
    CHECK(near(ranger.heading, 100 * degrees));
    const Scanner usual = carrying("ranger ( sensor ( ) )").only();
    CHECK(usual.finder.beams == 1);
    CHECK(usual.finder.range.value == 5);
    const Scanner two = carrying("ranger ( sensor ( samples 2 ) )").only();
    CHECK(near(two.finder.from, -0.05));
    CHECK(near(two.finder.to, 0.05));
}

TEST_CASE(
    "stage scanner: a ranger of Stage 4 with several sensors becomes a ring with one beam per "
    "sensor") {
    const Read world = read(
        "define eye sensor ( range [0 2] )\n"
        "position ( name \"a\" wifi ( model \"friis\" ) ranger ( pose [-0.1 0 0 180]\n"
        "  eye ( pose [0.1 0.2 0 30] ) eye ( pose [0.1 -0.2 0 -30] ) ) )\n");
    CHECK(world.notices.empty());
    const Scanner& ring = world.only();
    CHECK(ring.finder.kind == RangeFinderKind::ranger);
    REQUIRE(ring.size() == 2);
    CHECK(ring.at == Vec3{-0.1, 0});
    CHECK(near(ring.heading, std::numbers::pi));
    CHECK(ring.finder.range.value == 2);
    CHECK(near(ring.angles[0], 30 * degrees));
    CHECK(ring.places[1] == Vec3{0.1, -0.2});
    const Read mixed = carrying("ranger ( sensor ( range [0 3] ) sensor ( samples 5 ) )");
    CHECK(mixed.only().finder.range.value == 5);
    CHECK(mixed.only().size() == 2);
    REQUIRE(mixed.notices.size() == 2);
    CHECK(mixed.notices[0] ==
          "a.world:2: the sensors of this ranger have different ranges; in rovernet, all these "
          "sensors measure up to the largest range, 5 m");
    CHECK(mixed.notices[1].ends_with("one beam for each sensor: the middle sample of this sensor"));
}

TEST_CASE("stage scanner: a ranger of Stage 2 becomes a ring of sonars") {
    const Read world = carrying(
        "ranger ( scount 3 spose[0] [0.1 0.2 90] spose[2] [0 -0.2 -90] spose[1] [0.15 0 10]\n"
        " sview [0.1 4 15] ssize [0.01 0.05] spose[1] [0.15 0 0] )");
    CHECK(world.notices.empty());
    const Scanner& ring = world.only();
    CHECK(ring.finder.kind == RangeFinderKind::sonar);
    REQUIRE(ring.size() == 3);
    CHECK(ring.finder.range.value == 4);
    CHECK(near(ring.angles[0], 90 * degrees));
    CHECK(ring.angles[1].value == 0);
    CHECK(near(ring.angles[2], -90 * degrees));
    CHECK(ring.places[0] == Vec3{0.1, 0.2});
    CHECK(ring.places[1] == Vec3{0.15, 0});
    const Scanner all_round = carrying("ranger ( )").only();
    CHECK(all_round.finder.kind == RangeFinderKind::sonar);
    CHECK(all_round.finder.range.value == 5);
    REQUIRE(all_round.size() == 16);
    for (std::size_t i = 0; i < 16; ++i) {
        CHECK(near(all_round.beam(i).heading, 22.5 * degrees * static_cast<double>(i)));
    }
    CHECK(carrying("ranger ( scount 4 )").only().size() == 4);
    const Read holes = carrying("ranger ( scount 3 spose[0] [0 0 0] spose[2] [0 0 0] )");
    CHECK(holes.scan().empty());
    REQUIRE(holes.notices.size() == 1);
    CHECK(holes.notices[0] ==
          "a.world:2: this ranger is left out: it has 3 sonars, but no spose[1], which is the pose "
          "of one of these sonars");
    const Read views = carrying("ranger ( scount 1 spose[0] [0 0 0] sview[0] [0 1 5] )");
    CHECK(views.only().finder.range.value == 5);
    REQUIRE(views.notices.size() == 1);
}

TEST_CASE(
    "stage scanner: a robot gets all its own scanners, in the order of the world file, and no "
    "others") {
    const Read world = read(
        "define bot position ( wifi ( model \"friis\" ) ranger ( ) )\n"
        "laser ( )\n"
        "bot ( name \"a\" laser ( ) ranger ( sensor ( ) ) laser ( samples 5 )\n"
        "  position ( name \"b\" pose [1 0 0] wifi ( model \"friis\" ) laser ( samples 7 ) )\n"
        "  position ( laser ( samples 9 ) ) )\n"
        "position ( name \"c\" wifi ( model \"friis\" ) )\n");
    REQUIRE(world.robots.size() == 4);
    const auto& scan = world.scan();
    REQUIRE(scan.size() == 4);
    CHECK(scan[0].label() == "sonar");
    CHECK(scan[1].label() == "laser");
    CHECK(scan[2].label() == "ranger");
    CHECK(scan[3].label() == "laser1");
    CHECK(scan[3].finder.beams == 5);
    REQUIRE(world.robots[1].scan.size() == 1);
    CHECK(world.robots[1].scan[0].finder.beams == 7);
    REQUIRE(world.robots[2].scan.size() == 1);
    CHECK(world.robots[2].scan[0].finder.beams == 9);
    CHECK(world.robots[3].scan.empty());
    CHECK(world.notices.back() == "a.world: models of these types are ignored: laser (1)");
}

TEST_CASE("stage scanner: invalid values of laser and ranger are refused, with their line") {
    CHECK(mistake("\nlaser ( samples 0 )") ==
          "3: samples: found 0; expected a whole number from 1 to 10,000; such as samples 181");
    CHECK(mistake("laser ( samples 2.5 )").starts_with("2: samples: found 2.5"));
    CHECK(mistake("laser ( samples \"x\" )").starts_with("2: samples: found a text"));
    CHECK(mistake("laser (\nfov 400 )").starts_with("3: scan: found an angle of "));
    CHECK(mistake("laser (\nfov -10 )").starts_with("3: scan: found an angle of "));
    CHECK(mistake("laser (\nrange_max 0 )").starts_with("3: range"));
    CHECK(mistake("laser (\nupdate_interval 0 )").starts_with("3: every"));
    CHECK(mistake("laser ( pose 5 )").starts_with("2: pose: found a single value"));
    CHECK(mistake("ranger ( sensor ( range 5 ) )") ==
          "2: range: found no second number; expected range [min max]; such as range [0 5]");
    CHECK(mistake("ranger ( scount 20000 )").starts_with("2: scount: found 20000"));
    CHECK(mistake("ranger ( scount 1 spose[0] 3 )").starts_with("2: spose[0]: found a single"));
}

TEST_CASE(
    "stage scanner: range finders that a scenario gives to a robot replace those of the world") {
    const TemporaryFolder folder;
    folder.write("a.world",
                 "position ( name \"a\" pose [1 1 0] wifi ( model \"friis\" ) ranger ( scount 1 "
                 "spose[0] [0 0 0] ) )\n"
                 "position ( name \"b\" pose [3 1 0] wifi ( model \"friis\" ) laser ( ) )\n");
    const Scenario scenario = load_scenario(folder.write("a.toml", R"([scene]
world = "a.world"
[[robot]]
name = "a"
scan = { beams = 3 }
)"),
                                            {});
    REQUIRE(scenario.robots.size() == 2);
    REQUIRE(scenario.robots[0].scan.size() == 1);
    CHECK_FALSE(scenario.robots[0].scan[0].is_ring());
    CHECK(scenario.robots[0].scan[0].finder.beams == 3);
    CHECK(scenario.robots[1].scan[0].finder.beams == 180);
}

TEST_CASE(
    "stage scanner: robots of the worlds that came with Stage get the right sonars and lasers") {
    const char* folder = std::getenv("ROVERNET_WORLDS");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_WORLDS is not set");
        return;
    }
    const std::string place = folder;
    const auto load = [&](const std::string& world) {
        return load_scenario(place + "/stage-wifi/" + world,
                             {.world_path = {place + "/stage-include", place + "/stage-wifi"}});
    };
    const Scenario commando = load("commando.world");
    REQUIRE(commando.robots.size() == 2);
    for (const RobotTable& robot : commando.robots) {
        REQUIRE(robot.scan.size() == 2);
        CHECK(robot.scan[0].label() == "sonar");
        CHECK(robot.scan[0].size() == 16);
        CHECK(robot.scan[0].finder.range.value == 5);
        CHECK(robot.scan[0].places[15] == Vec3{-0.155, 0.13});
        CHECK(near(robot.scan[0].angles[9], -130 * degrees));
        CHECK(robot.scan[1].label() == "laser");
        CHECK(robot.scan[1].finder.beams == 181);
    }
    const Scenario hospital = load("hosp_wifi.world");
    REQUIRE(hospital.robots.size() == 2);
    REQUIRE(hospital.robots[1].scan.size() == 1);
    CHECK(hospital.robots[1].scan[0].finder.beams == 180);
}

}  // namespace stage_scanner_test
