// SPDX-License-Identifier: MIT
#include "experiment/movement_play.hpp"

#include "experiment/reports/network_at.hpp"
#include "experiment/session.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace movement_play_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::TemporaryFolder;

namespace {

constexpr double rounding = 1e-6;  // [m] of times in nanoseconds at 2 m/s, and of speeds in a file

bool near(Vec3 a, Vec3 b) { return distance(a, b) < rounding; }

/// Movement file of one robot, in one of three formats: the robot goes from (0, 0) to (20, 0) until
/// 10 s, and to (20, 20) until 20 s.
struct Format {
    std::string file, robot, content;
};
const std::vector<Format> formats{
    {"m.movements", "n0", "0 0 0 10 20 0 20 20 20\n"},
    {"m.tcl", "n0",
     "$node_(0) set X_ 0\n$node_(0) set Y_ 0\n$ns_ at 0.0 \"$node_(0) setdest 20 0 2\"\n"
     "$ns_ at 10.0 \"$node_(0) setdest 20 20 2\"\n"},
    {"m.xml", "car",
     "<fcd-export><timestep time=\"0\"><vehicle id=\"car\" x=\"0\" y=\"0\"/></timestep>"
     "<timestep time=\"10\"><vehicle id=\"car\" x=\"20\" y=\"0\"/></timestep>"
     "<timestep time=\"20\"><vehicle id=\"car\" x=\"20\" y=\"20\"/></timestep></fcd-export>\n"}};

/// Folder with the file of one format, and a scenario of 30 s in which it moves its robot.
struct Played {
    TemporaryFolder folder;
    Scenario scenario;

    /// @param keys  keys of the robot's table
    Played(const Format& format, const std::string& keys) {
        folder.write(format.file, format.content);
        scenario = load_scenario(
            folder.write("s.toml", "[scenario]\nduration = \"30 s\"\n[movement]\nfile = \"" +
                                       format.file + "\"\n[[robot]]\nname = \"" + format.robot +
                                       "\"\n" + keys),
            {});
    }
};

}  // namespace

TEST_CASE(
    "movement file: robots move exactly as in the file, whatever their top speed and turn rate") {
    for (const Format& format : formats) {
        for (const std::string keys :
             {"", "top_speed = \"1 m/s\"\n", "turn_rate = \"10 deg/s\"\n",
              "heading = \"90 deg\"\ntop_speed = \"0.5 m/s\"\nturn_rate = \"1 deg/s\"\n"}) {
            CAPTURE(format.file);
            CAPTURE(keys);
            const Played played(format, keys);
            const auto at = [&](Duration t) {
                const auto network = network_at(played.scenario, start_of_run + t);
                return network->position(*network->find(format.robot));
            };
            CHECK(near(at(5s), {10, 0, 0}));
            CHECK(near(at(10s), {20, 0, 0}));
            CHECK(near(at(15s), {20, 10, 0}));
            CHECK(near(at(20s), {20, 20, 0}));
        }
    }
}

TEST_CASE("movement file: a [[robot]] table with `count` may describe robots that the file moves") {
    const TemporaryFolder folder;
    folder.write("m.movements", "0 0 0 10 20 0\n0 1 5 10 21 5\n");
    const Scenario s =
        load_scenario(folder.write("s.toml",
                                   "[movement]\nfile = \"m.movements\"\n[[robot]]\nname = \"n\"\n"
                                   "count = 2\nradius = \"3 m\"\nmove = { model = \"fixed\" }\n"),
                      {});
    const auto network = network_at(s, start_of_run + 5s);
    REQUIRE(network->size() == 2);
    CHECK(near(network->position(*network->find("n1")), {11, 5, 0}));
    CHECK(network->robot(*network->find("n1")).radius == 3_m);
}

TEST_CASE(
    "movement file: a robot moves as in the file, even if a Stage world gives it another "
    "position") {
    const TemporaryFolder folder;
    folder.write("m.movements", "0 0 0 10 20 0\n");
    folder.write("w.world", "position ( name \"n0\" pose [5 6 0] )\n");
    const std::string text = "[movement]\nfile = \"m.movements\"\n[scene]\nworld = \"w.world\"\n";
    const Scenario s = load_scenario(folder.write("s.toml", text), {});
    const auto network = network_at(s, start_of_run + 5s);
    CHECK(near(network->position(*network->find("n0")), {10, 0, 0}));
    const std::string own =
        folder.write("own.toml", text + "[[robot]]\nname = \"n0\"\nat = [\"2 m\", \"2 m\"]\n");
    const auto idle = [](const Scenario& each) {
        return std::count_if(each.notices.begin(), each.notices.end(), [](const auto& notice) {
            return notice.find("the key \"at\" has no effect on robot \"n0\"") != notice.npos;
        });
    };
    CHECK(idle(s) == 0);
    CHECK(idle(load_scenario(own, {})) == 1);
}

TEST_CASE(
    "movement file: after a motion command of a program, a robot no longer follows the file") {
    const Format walk{"m.movements", "n0", "0 0 0 4 4 0 6 4 0 10 4 4\n"};
    const Played played(walk, "");
    const auto x_after_12_s = [&](const RobotCommand& command) {
        Session session(played.scenario);
        const NodeId n0 = *session.network().find("n0");
        const ClientId client = session.attach({n0});
        session.step(start_of_run + 1s);
        session.carry_out(client, n0, command);
        session.step(start_of_run + 12s);
        return session.network().position(n0).x;
    };
    CHECK(std::abs(x_after_12_s(DriveCommand{.speed = {-1}}) - (1 - 11)) < rounding);
    CHECK(std::abs(x_after_12_s(DriveCommand{.speed = {-1}, .timeout = 2s}) - (1 - 2)) < rounding);
    CHECK(x_after_12_s(GoalCommand{.to = {-3, 0}}) == -3);
    CHECK(std::abs(x_after_12_s(StopCommand{}) - 1) < rounding);
    CHECK(x_after_12_s(PlaceCommand{.at = {7, 8}, .heading = {}}) == 7);
    CHECK(std::abs(x_after_12_s(SendCommand{.payload = "x", .one_hop = true}) - 4) < rounding);
}

TEST_CASE(
    "movement file: after a reaction that stops or moves a robot, it no longer follows the file") {
    const Format walk{"m.movements", "n0", "0 0 0 4 4 0 6 4 0 10 4 4\n"};
    for (const auto& [reaction, x] :
         {std::pair<std::string, double>{"stop = true", 1},
          {"move = { model = \"goal\", to = [\"-9 m\", \"0 m\"] }", -9}}) {
        const Played played(walk, "on_time = { time = \"1 s\", " + reaction + " }\n");
        const auto network = network_at(played.scenario, start_of_run + 20s);
        CHECK(std::abs(network->position(*network->find("n0")).x - x) < rounding);
    }
}

TEST_CASE("movement file: if a program drives a robot, the file can no longer remove this robot") {
    const Format bus{"m.xml", "bus",
                     "<fcd-export><timestep time=\"1\"><vehicle id=\"bus\" x=\"5\" y=\"0\"/>"
                     "</timestep><timestep time=\"4\"><vehicle id=\"bus\" x=\"8\" y=\"0\"/>"
                     "</timestep><timestep time=\"5\"/></fcd-export>\n"};
    const Played played(bus, "");
    for (const bool is_commanded : {false, true}) {
        Session session(played.scenario);
        Network& net = session.network();
        const NodeId node = *net.find("bus");
        const ClientId client = session.attach({node});
        session.drive(client, node, {9}, {0});  // it is not there yet: the file brings it
        session.step(start_of_run + 2s);
        CHECK(near(net.position(node), {6, 0, 0}));
        if (is_commanded) session.drive(client, node, {0}, {1});
        session.step(start_of_run + 10s);
        CHECK(net.robot(node).presence == (is_commanded ? Presence::on : Presence::left));
        CHECK(near(net.position(node), {is_commanded ? 6.0 : 8.0, 0, 0}));
    }
}

}  // namespace movement_play_test
