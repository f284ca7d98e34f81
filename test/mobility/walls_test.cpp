// SPDX-License-Identifier: MIT
// No robot crosses a wall, whatever its movement model.
#include "mobility/follow.hpp"
#include "mobility/follow_wall.hpp"
#include "mobility/gauss_markov.hpp"
#include "mobility/group.hpp"
#include "mobility/patrol.hpp"
#include "mobility/random_direction.hpp"
#include "mobility/random_walk.hpp"
#include "mobility/random_waypoint.hpp"
#include "mobility/wander.hpp"
#include "network/network.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace walls_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;

namespace {

constexpr Meters radius{0.25};

/// Rooms along a corridor, with doors of 1 m and some furniture.
std::shared_ptr<const Scene> office() {
    return std::make_shared<Scene>(test::drawn_map(
        {
            "##########################################",
            "#............#.............#.............#",
            "#............#.............#.............#",
            "#....##......#.............#....###......#",
            "#....##......#......#......#....###......#",
            "#............#......#......#.............#",
            "#............#......#....................#",
            "#............#......#....................#",
            "#####..#############################..####",
            "#........................................#",
            "#........................................#",
            "#..................##....................#",
            "#......................................?.#",
            "##########..####################..########",
            "#.................#......................#",
            "#.................#......................#",
            "#...#.............#..........####........#",
            "#...#....................................#",
            "#........................................#",
            "##########################################",
        },
        0.5));
}

/// Walks so many legs, a fresh robot every hundred, and tells how many are not passable.
template <class Model>
int bad_legs(const Scene& scene, const Model& model, int legs) {
    Planners planners(scene);
    int bad = 0;
    for (int i = 0; i < legs; i += 100) {
        Model movement = model;
        RandomWalk anywhere;
        LoneMover place(planners, static_cast<std::uint64_t>(i), {}, radius);
        REQUIRE(place.walk(anywhere));
        LoneMover robot(planners, static_cast<std::uint64_t>(i), place.leg.from, radius);
        REQUIRE(robot.walk(movement));
        for (int k = 0; k < 100; ++k) {
            REQUIRE(robot.walk(movement));
            const Leg& leg = robot.leg;
            bad += !scene.passable(leg.from, leg.to, radius) || !scene.inside_map(leg.to);
        }
    }
    return bad;
}

/// All legs of a network's robots, checked as they come.
struct LegCheck {
    const Scene* scene;
    int legs = 0;
    int bad = 0;

    KindMask kinds() const { return kind_of<Moved>(); }
    void on(const Record& record, const RecordContext&) {
        const auto* moved = std::get_if<Moved>(&record);
        if (!moved || moved->node == NodeId{0}) return;
        ++legs;
        bad += !scene->passable(moved->leg.from, moved->leg.to, radius);
    }
};

/// Robots that go by a leader, which wanders, until they have gone so many legs.
LegCheck led(const std::shared_ptr<const Scene>& scene, const Movement& movement, int legs) {
    Network net({.scene = scene, .metrics = false});
    const auto check = std::make_shared<LegCheck>(LegCheck{.scene = scene.get()});
    net.add_sink(check);
    net.add({.name = "leader", .at = {}, .radius = radius, .move = RandomWaypoint{.pause = 3s}});
    Planners planners(*scene);
    for (int i = 0; i < 10; ++i) {
        LoneMover place(planners, static_cast<std::uint64_t>(i) + 100, {}, radius);
        RandomWalk anywhere;
        REQUIRE(place.walk(anywhere));
        net.add({.name = {}, .at = place.leg.from, .radius = radius, .move = movement});
    }
    for (int minute = 0; check->legs < legs && minute < 1000; ++minute) net.run_for(1min);
    return *check;
}

void check_models(const std::shared_ptr<const Scene>& scene, const std::vector<Vec3>& path,
                  int legs) {
    CHECK(bad_legs(*scene, RandomWaypoint{.pause = 1s}, legs) == 0);
    CHECK(bad_legs(*scene, RandomDirection{.pause = 1s}, legs) == 0);
    CHECK(bad_legs(*scene, RandomDirection{.border_turn = BorderTurn::uniform}, legs) == 0);
    CHECK(bad_legs(*scene, RandomWalk{}, legs) == 0);
    CHECK(bad_legs(*scene, GaussMarkov{}, legs) == 0);
    CHECK(bad_legs(*scene, Wander{}, legs) == 0);
    CHECK(bad_legs(*scene, FollowWall{}, legs) == 0);
    if (!path.empty()) {
        Patrol patrol{.path = path};
        Planners planners(*scene);
        LoneMover robot(planners, 0, path.back(), radius);
        for (int i = 0; i < legs; ++i) {
            REQUIRE(robot.walk(patrol));
            REQUIRE(scene->passable(robot.leg.from, robot.leg.to, radius));
        }
    }
    for (const Movement& movement : {Movement{Follow{}}, Movement{Group{.radius = {3}}}}) {
        const LegCheck check = led(scene, movement, legs);
        CHECK(check.legs >= legs);
        CHECK(check.bad == 0);
    }
}

/// A picture of the folder that ROVERNET_WORLDS names, if it is there.
std::shared_ptr<const Scene> world(const std::string& picture, Meters width, Meters height) {
    const char* folder = std::getenv("ROVERNET_WORLDS");
    if (folder == nullptr) {
        MESSAGE("skipped: ROVERNET_WORLDS is not set");
        return nullptr;
    }
    return std::make_shared<Scene>(
        image_map(std::string(folder) + "/stage-wifi/bitmaps/" + picture + ".png", width, height));
}

}  // namespace

TEST_CASE("movement models: in an office none of 10,000 pieces of movement crosses a wall") {
    check_models(office(), {{1, 1}, {18, 8}, {2, 8}, {19, 1}}, 10'000);
}

TEST_CASE("movement models: on the rescue example's map no piece of movement crosses a wall") {
    const auto map =
        std::make_shared<Scene>(read_ros_map(std::string(ROVERNET_EXAMPLES) + "/rescue/map.yaml"));
    check_models(map, {}, 100);
}

TEST_CASE("movement models: in the hospital none of 14,000 pieces of movement crosses a wall") {
    if (const auto map = world("hospital_section", {40}, {18})) check_models(map, {}, 2000);
}

TEST_CASE("movement models: in the cave none of 14,000 pieces of movement crosses a wall") {
    if (const auto map = world("cave", {16}, {16})) check_models(map, {}, 2000);
}

}  // namespace walls_test
