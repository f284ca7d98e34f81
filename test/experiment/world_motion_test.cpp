// SPDX-License-Identifier: MIT
// Robots in a Stage world, whose ground is free around its walls.
#include "experiment/reports/network_at.hpp"
#include "experiment/session.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>

namespace world_motion_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::TemporaryFolder;

namespace {

constexpr double before = 2e-6;  // [m] that robots stop before a wall, at most

/// A box of 1 m at (2, 0), and robots of radius 0.2 m on both sides of it.
const std::string box = R"(position ( name "a" pose [5 0 0] )
model ( size [1 1 1] pose [2 0 0 0] )
position ( name "b" pose [-20 0 0] )
)";

/// Scenario over the world of the box.
Scenario scenario(const std::string& more = {}) {
    const TemporaryFolder folder;
    folder.write("box.world", box);
    return load_scenario(folder.write("s.toml", "[scenario]\nduration = \"100 s\"\n" + more +
                                                    "\n[scene]\nworld = \"box.world\"\n"),
                         {});
}

/// Position of robot a after `t`, in a scenario that adds `keys` to it.
Vec3 place_of_a(const std::string& keys, Duration t, const std::string& more = {}) {
    const auto net =
        network_at(scenario(more + "[[robot]]\nname = \"a\"\n" + keys), start_of_run + t);
    return net->position(*net->find("a"));
}

struct Clients {
    Session session{scenario()};
    NodeId a = *session.network().find("a"), b = *session.network().find("b");
    ClientId client = session.attach({a, b});

    Vec3 at(NodeId robot) { return session.network().position(robot); }
    void run(Duration d) { session.step(session.network().now() + d); }
};

}  // namespace

TEST_CASE("Stage world: a robot drives anywhere around the walls, and stops only at a wall") {
    Clients clients;
    clients.session.drive(clients.client, clients.a, {-1}, {0});
    clients.session.drive(clients.client, clients.b, {1}, {0});
    clients.run(1s);
    CHECK(distance(clients.at(clients.a), {4, 0}) < 1e-9);
    CHECK(distance(clients.at(clients.b), {-19, 0}) < 1e-9);
    CHECK_FALSE(clients.session.is_stalled(clients.a));
    clients.run(29s);
    CHECK(std::abs(clients.at(clients.a).x - 2.7) < before);
    CHECK(std::abs(clients.at(clients.b).x - 1.3) < before);
    CHECK(clients.session.is_stalled(clients.a));
    CHECK(clients.session.is_stalled(clients.b));
    clients.session.drive(clients.client, clients.a, {100}, {0});
    clients.session.drive(clients.client, clients.b, {-1}, {-0.5});  // on a circle of 2 m
    clients.run(4s);
    CHECK(distance(clients.at(clients.a), {402.7, 0}) < 1e-5);
    CHECK(std::abs(distance(clients.at(clients.b), {1.3, 2}) - 2) < 0.01);
    CHECK_FALSE(clients.session.is_stalled(clients.b));
}

TEST_CASE(
    "Stage world: programs may send robots to, and place them at, positions far outside the "
    "walls") {
    Clients clients;
    const auto why_not = [&](const RobotCommand& command) {
        return clients.session.why_not(clients.a, command);
    };
    CHECK(why_not(GoalCommand{.to = {30, 0}}).empty());
    CHECK(why_not(PlaceCommand{.at = {-300, 70}, .heading = {}}).empty());
    CHECK(why_not(PlaceCommand{.at = {2, 0}, .heading = {}}).find("is in a wall") !=
          std::string::npos);
    clients.session.carry_out(clients.client, clients.a, GoalCommand{{30, 0}, {5}});
    clients.session.carry_out(clients.client, clients.b, GoalCommand{{20, 0}, {2}});
    clients.run(30s);
    CHECK(clients.at(clients.a) == Vec3{30, 0});
    CHECK(clients.at(clients.b) == Vec3{20, 0});  // around the box
    CHECK_FALSE(clients.session.has_no_way(clients.b));
    clients.session.carry_out(clients.client, clients.a, GoalCommand{{2, 0}, {5}});
    clients.run(1s);
    CHECK(clients.session.has_no_way(clients.a));
}

TEST_CASE("Stage world: every movement of a scenario leads around the walls, also far from them") {
    CHECK(place_of_a("move = { model = \"goal\", to = [\"7 m\", \"0 m\"] }\n", 10s) == Vec3{7, 0});
    CHECK(place_of_a("move = { model = \"goal\", to = [\"-3 m\", \"0 m\"] }\n", 10s) ==
          Vec3{-3, 0});
    CHECK(place_of_a("move = { model = \"waypoints\", path = [[\"-9 m\", \"9 m\"], [\"1 m\", \"-1 "
                     "m\"]] }\n",
                     60s) == Vec3{1, -1});
    for (const std::string model : {"random_waypoint", "random_direction", "random_walk"}) {
        CAPTURE(model);
        const std::string keys =
            "move = { model = \"" + model +
            "\", start = \"here\", area = [[\"-10 m\", \"-10 m\"], [\"10 m\", \"10 m\"]], "
            "min_speed = \"1 m/s\", max_speed = \"1 m/s\" }\n";
        CHECK(distance(place_of_a(keys, 1s), {5, 0}) > 0.9);
        CHECK(distance(place_of_a(keys, 50s), place_of_a(keys, 51s)) > 0.4);
    }
}

TEST_CASE(
    "Stage world: a goal inside a wall is refused, with an error that does not mention a map") {
    const Scenario s =
        scenario("[[robot]]\nname = \"a\"\nmove = { model = \"goal\", to = [\"2 m\", \"0 m\"] }\n");
    std::string why;
    try {
        network_at(s, start_of_run);
    } catch (const InputError& error) {
        why = error.what();
    }
    CHECK(why.find("no path from (5, 0) m to (2, 0) m") != why.npos);
    CHECK(why.find("the destination is in a wall, or too near to a wall") != why.npos);
    CHECK(why.find("the map") == why.npos);
    for (const std::string& notice : scenario().notices) {
        CHECK(notice.find("off the map") == notice.npos);
    }
}

TEST_CASE(
    "Stage world: a door may stand anywhere on the ground, and stops robots while it is closed") {
    const std::string door =
        "[[scene.door]]\nfrom = [\"10 m\", \"-5 m\"]\nto = [\"10 m\", \"5 m\"]\n"
        "thickness = \"0.2 m\"\ncloses = [\"0 s\"]\nopens = [\"20 s\"]\n";
    const std::string goal = "move = { model = \"goal\", to = [\"15 m\", \"0 m\"] }\n";
    CHECK(std::abs(place_of_a(goal, 15s, door).x - 9.7) < before);
    CHECK(place_of_a(goal, 30s, door) == Vec3{15, 0});
}

}  // namespace world_motion_test
