// SPDX-License-Identifier: MIT
// Several range finders of a robot, as Player clients find them.
#include "test/live/player/player_talk.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace range_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

constexpr std::uint32_t sonar = 5, laser = 6, ranger = 62;
constexpr double pi = std::numbers::pi;

/// Two robots, 4 m apart; the first looks at the second and has a laser that looks away from it.
std::string with_scans(const std::string& first, const std::string& second) {
    return "[scenario]\nduration = \"60 s\"\n[[robot]]\nname = \"robot1\"\nat = [\"0 m\", \"0 "
           "m\"]\nscan = " +
           first + "\n[[robot]]\nname = \"robot2\"\nat = [\"4 m\", \"0 m\"]\nscan = " + second +
           "\n";
}
const std::string ahead = R"({ beams = 1, from = "0 deg", to = "0 deg" })";
const std::string rear =
    R"({ name = "rear", beams = 1, from = "0 deg", to = "0 deg", at = ["-0.5 m", "0.25 m"], )"
    R"(heading = "180 deg", range = "3 m" })";
const std::string ring =
    R"({ kind = "sonar", at = ["0.5 m", "0 m"], heading = "90 deg", angles = ["-90 deg", )"
    R"("0 deg"], places = [["0 m", "0 m"], ["0.25 m", "0 m"]] })";
const std::string eyes =
    R"({ kind = "ranger", at = ["0.5 m", "0 m"], angles = ["45 deg", "0 deg", "-45 deg"] })";

/// The last data of a device after 0.1 s; empty if it has none.
std::string told(PlayerTalk& talk, std::uint32_t interface, std::uint32_t index) {
    const auto client = talk.come();
    talk.say(client, device(interface, index));
    talk.run_for(100ms);
    std::string payload;
    for (const Wire& each : talk.told(client)) {
        const bool is_it = each.interface == interface && each.index == index;
        if (each.type == data && is_it) payload = each.payload;
    }
    return payload;
}

/// Payload of the answer to a request; "refused" if it is.
std::string answer(PlayerTalk& talk, std::uint32_t interface, std::uint32_t index,
                   std::uint32_t subtype) {
    const auto client = talk.come();
    const auto all = talk.ask(client, request(interface, index, subtype));
    REQUIRE(all.size() == 1);
    return all[0].type == ack ? all[0].payload : "refused";
}

}  // namespace

TEST_CASE("player: the lasers of a robot are laser:0 and laser:1; sonar and ranger have index 0") {
    PlayerTalk talk(
        player_scenario(with_scans("[" + ahead + ", " + ring + ", " + rear + "]", eyes)));
    const std::string first = told(talk, laser, 0), second = told(talk, laser, 1);
    CHECK(float_at(first, 12) == 8);
    CHECK(float_at(first, 24) == 3.8F);
    CHECK(float_at(second, 12) == 3);
    CHECK(float_at(second, 24) == 3);
    const std::string distances = told(talk, sonar, 0);
    REQUIRE(distances.size() == 16);
    CHECK(distances.substr(0, 8) == be32(2) + be32(2));
    CHECK(float_at(distances, 8) == 3.3F);
    CHECK(float_at(distances, 12) == 8);
    CHECK(told(talk, laser, 2).empty());
    CHECK(told(talk, sonar, 1).empty());
    CHECK(told(talk, ranger, 0).empty());
}

TEST_CASE(
    "player: a request for the geometry returns the position of a range finder and the origins of "
    "its beams") {
    PlayerTalk talk(player_scenario(
        with_scans("[" + ahead + ", " + rear + ", " + ring + ", " + eyes + "]", "{}")));
    CHECK(answer(talk, laser, 0, 1) == std::string(72, '\0'));
    CHECK(answer(talk, laser, 1, 1) == doubles({-0.5, 0.25, 0, 0, 0, pi, 0, 0, 0}));
    const std::string poses = answer(talk, sonar, 0, 1);
    REQUIRE(poses.size() == 8 + 2 * 48);
    CHECK(poses.substr(0, 8) == be32(2) + be32(2));
    CHECK(double_at(poses, 8) == 0.5);
    CHECK(double_at(poses, 8 + 40) == doctest::Approx(0));
    CHECK(double_at(poses, 56) == doctest::Approx(0.5));  // 0.25 m along its heading, 90 degrees
    CHECK(double_at(poses, 64) == doctest::Approx(0.25));
    CHECK(double_at(poses, 56 + 40) == doctest::Approx(pi / 2));
    CHECK(answer(talk, ranger, 0, 1) == doubles({0.5, 0, 0, 0, 0, 0, 0, 0, 0}) + be32(3) + be32(3) +
                                            doubles({0, 0, 0, 0, 0, 45 * (pi / 180)}) +
                                            doubles({0, 0, 0, 0, 0, 0}) +
                                            doubles({0, 0, 0, 0, 0, -45 * (pi / 180)}) + be32(3) +
                                            be32(3) + std::string(72, '\0'));
    CHECK(answer(talk, ranger, 0, 5) ==
          doubles({-45 * (pi / 180), 45 * (pi / 180), 0, 0, 8, 0, 10}));
    CHECK(answer(talk, sonar, 0, 9) == "refused");
}

TEST_CASE("player: if robots share a port, each robot has the same number of device indices") {
    const std::vector<PlayerPlace> places = {{"robot1", 0, 0}, {"robot2", 0, 1}};
    PlayerTalk alike(player_scenario(with_scans("{ range = \"1 m\" }", "{ range = \"2 m\" }")),
                     {.places = places});
    CHECK(float_at(told(alike, laser, 0), 12) == 1);
    CHECK(float_at(told(alike, laser, 1), 12) == 2);
    PlayerTalk more(player_scenario(with_scans("[" + rear + ", " + ring + "]",
                                               "[{ range = \"5 m\" }, { range = \"6 m\" }]")),
                    {.places = places});
    CHECK(float_at(told(more, laser, 0), 12) == 3);
    CHECK(told(more, laser, 1).empty());
    CHECK(float_at(told(more, laser, 2), 12) == 5);
    CHECK(float_at(told(more, laser, 3), 12) == 6);
    CHECK(told(more, sonar, 0).size() == 16);
    PlayerTalk apart(player_scenario(with_scans("[{}, {}]", "{ range = \"5 m\" }")),
                     {.places = {{"robot1", 0, 0}, {"robot2", 1, 1}}});
    const auto client = apart.come(1);
    CHECK(apart.ask(client, request(laser, 1, 1))[0].type == ack);
}

}  // namespace range_test
