// SPDX-License-Identifier: MIT
#include "experiment/reports/whereabouts.hpp"

#include "models/medium/medium.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

namespace whereabouts_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Here from the start to 2 s, and from 2 s to 4 s.
constexpr const char* two_vehicles =
    "<fcd-export>\n"
    "<timestep time=\"0\"><vehicle id=\"early\" x=\"0\" y=\"0\"/></timestep>\n"
    "<timestep time=\"1\"><vehicle id=\"early\" x=\"10\" y=\"0\"/></timestep>\n"
    "<timestep time=\"2\"><vehicle id=\"late\" x=\"0\" y=\"40\"/></timestep>\n"
    "<timestep time=\"3\"><vehicle id=\"late\" x=\"20\" y=\"40\"/></timestep>\n"
    "<timestep time=\"4\"></timestep>\n"
    "</fcd-export>\n";

std::vector<Presence> presences(const Whereabouts& now) {
    std::vector<Presence> out;
    for (const auto& robot : now.robots) out.push_back(robot.presence);
    return out;
}

using Presences = std::vector<Presence>;

}  // namespace

TEST_CASE(
    "whereabouts: a vehicle is reported as not yet departed, then as present, and at last as "
    "gone") {
    test::TemporaryFolder folder;
    const Scenario s = load_scenario(folder.write("fcd.xml", two_vehicles), {});
    const auto all =
        whereabouts(s, {start_of_run + 500ms, start_of_run + 2500ms, start_of_run + 9s});
    CHECK(presences(all[0]) == Presences{Presence::on, Presence::not_departed});
    CHECK(presences(all[1]) == Presences{Presence::left, Presence::on});
    CHECK(presences(all[2]) == Presences{Presence::left, Presence::left});
    CHECK(all[0].robots[1].position == Vec3{0, 40, 0});  // where it will appear
}

TEST_CASE(
    "whereabouts: a robot is reported as off from when it is switched off until it is switched "
    "on") {
    test::TemporaryFolder folder;
    const Scenario s = load_scenario(
        folder.write("s.toml",
                     "[[robot]]\nname = \"a\"\nat = [\"0 m\", \"0 m\"]\noff = [\"1 s\"]\n"
                     "on = [\"3 s\"]\n"),
        {});
    const auto all = whereabouts(s, {start_of_run, start_of_run + 2s, start_of_run + 4s});
    CHECK(all[0].robots[0].presence == Presence::on);
    CHECK(all[1].robots[0].presence == Presence::off);
    CHECK(all[2].robots[0].presence == Presence::on);
}

TEST_CASE("whereabouts: the answers are in the order of the requested times") {
    test::TemporaryFolder folder;
    const Scenario s = load_scenario(folder.write("fcd.xml", two_vehicles), {});
    const std::vector<Time> times{start_of_run + 3s, start_of_run, start_of_run + 1s, start_of_run};
    const auto all = whereabouts(s, times);
    REQUIRE(all.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(all[i].time == times[i]);
    CHECK(all[2].robots[0].position == Vec3{10, 0, 0});
}

TEST_CASE(
    "network: take_away() switches a robot's radio off and stores the reason, until switch_on()") {
    Network net;
    const NodeId a = net.add({.name = "a", .at = {}, .radius = {0.7}});
    CHECK(net.robot(a).presence == Presence::on);
    CHECK(net.robot(a).radius.value == 0.7);
    net.take_away(a, Presence::not_departed);
    CHECK(net.robot(a).presence == Presence::not_departed);
    CHECK_FALSE(net.medium().stations().is_on(a));
    net.switch_on(a);
    CHECK(net.robot(a).presence == Presence::on);
    net.switch_off(a);
    CHECK(net.robot(a).presence == Presence::off);
    net.take_away(a, Presence::left);
    CHECK(net.robot(a).presence == Presence::left);
}

}  // namespace whereabouts_test
