// SPDX-License-Identifier: MIT
// [[scene.door]]: doors as scenarios give them.
#include "scenario/door_table.hpp"

#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "models/medium/medium.hpp"
#include "network/network.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace door_table_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::TemporaryFolder;

namespace {

/// A wall at x = 4 with a gap at y = 2, in pixels of 1 m.
struct House {
    TemporaryFolder folder;
    House() {
        const std::vector<png_byte> wall{255, 255, 255, 255, 0, 255, 255, 255, 255, 255};
        const std::vector<png_byte> gap(10, 255);
        folder.write("house.png",
                     test::png_bytes({.width = 10, .height = 4, .rows = {wall, gap, wall, wall}}));
    }
    Scenario scenario(const std::string& text) const {
        return load_scenario(folder.write("s.toml", text), {});
    }
};

const std::string map = "[scene]\nmap = \"house.png\"\nsize = [\"10 m\", \"4 m\"]\n";
const std::string materials = "[scene.materials]\nwood = { per_crossing = \"7 dB\" }\n";
const std::string door =
    "[[scene.door]]\nname = \"lab\"\nfrom = [\"4.5 m\", \"2 m\"]\nto = [\"4.5 m\", \"3 m\"]\n";
const std::string times = "closes = [\"10 s\"]\nopens = [\"20 s\"]\n";
const std::string robots = R"([propagation]
model = "multi_wall"
[[robot]]
name = "a"
at = ["1 m", "2.5 m"]
[[robot]]
name = "b"
at = ["8 m", "2.5 m"]
)";

}  // namespace

TEST_CASE(
    "door: a closed door has the loss of its material, by default the propagation model's loss of "
    "a wall") {
    const House house;
    for (const bool named : {true, false}) {
        const Scenario s =
            house.scenario(map + materials + door + times + "material = \"wood\"\n" + robots);
        Scenario usual = house.scenario(map + door + times + robots);
        Network network(network_settings(named ? s : usual));
        populate(network, named ? s : usual);
        network.run_until(start_of_run);
        const auto level = [&](Duration t) {
            return network.medium().links().level(NodeId{0}, NodeId{1}, start_of_run + t,
                                                  network.legs());
        };
        CHECK(level(10s - 1ns) == level(0s));
        CHECK(level(20s) == level(0s));
        CHECK(level(20s - 1ns) == level(10s));
        const double lost = (level(0s) - level(10s)).value;
        if (named) {
            CHECK(std::abs(lost - 7) < 1e-9);
        } else {
            CHECK(std::abs(lost - 3.4) < 1e-9);  // a light wall of multi_wall
        }
        CHECK(network.settings().scene_changes.size() == 2);
    }
}

TEST_CASE(
    "door: a door can have any material of the scenario, even a material with the name wall") {
    const House house;
    const Scenario s =
        house.scenario(map + "[scene.materials]\nwall = { per_crossing = \"9 dB\" }\n" + door +
                       times + "material = \"wall\"\n" + robots);
    Network network(network_settings(s));
    populate(network, s);
    network.run_until(start_of_run);
    const auto level = [&](Duration t) {
        return network.medium().links().level(NodeId{0}, NodeId{1}, start_of_run + t,
                                              network.legs());
    };
    CHECK(std::abs((level(0s) - level(10s)).value - 9) < 1e-9);
}

TEST_CASE("door: a printed door is read back unchanged") {
    const House house;
    const std::string text = map + materials + door + times +
                             "material = \"wood\"\nthickness = \"8 cm\"\n" +
                             "[[scene.door]]\nfrom = [\"1 m\", \"1 m\"]\nto = [\"2 m\", \"1.5 "
                             "m\"]\ncloses = [\"3 s\"]\n" +
                             robots;
    const Scenario first = house.scenario(text);
    REQUIRE(first.scene.doors.size() == 2);
    CHECK(first.scene.doors[0].thickness == 0.08_m);
    CHECK(first.scene.doors[0].closes == std::vector<Duration>{10s});
    CHECK(first.scene.doors[0].opens == std::vector<Duration>{20s});
    const std::string printed = to_toml(to_document(first));
    const Scenario again = house.scenario(printed);
    CHECK(to_toml(to_document(again)) == printed);
    CHECK(again.scene.doors[1].to == Vec3{2, 1.5, 0});
    CHECK(first.notices.empty());
}

TEST_CASE("door: the message for an error in a door has line, column and what was expected") {
    const House house;
    struct Mistake {
        std::string text, where;
        std::vector<std::string> words;
    };
    const std::string from = "from = [\"4.5 m\", \"2 m\"]\n", to = "to = [\"4.5 m\", \"3 m\"]\n";
    const std::string begin = map + "[[scene.door]]\n";
    const std::vector<Mistake> mistakes = {
        {"[scene]\ndoor = 3\n", "2:8", {"[[scene.door]]"}},
        {begin + to + times, "4:1", {"\"from\" is missing"}},
        {begin + from + times, "4:1", {"\"to\" is missing"}},
        {begin + from + to, "4:1", {"\"closes\" is missing"}},
        {begin + from + to + "close = [\"3 s\"]\n", "7:1", {"closes"}},
        {begin + from + "to = [\"4.5 m\", \"2 m\"]\n" + times, "6:6", {"other end"}},
        {begin + from + to + "closes = [\"-3 s\"]\n", "7:10", {"before 0 s"}},
        {begin + from + to + "closes = [\"3 s\"]\nopens = [\"3 s\"]\n", "8:9", {"3 s", "closes"}},
        {begin + from + to + times + "thickness = \"0 m\"\n", "9:13", {"thickness"}},
        {map + materials + door + times + "material = \"wod\"\n", "12:12", {"wod", "\"wood\"?"}},
        {begin + from + "to = [\"4.5 m\", \"5 m\"]\n" + times, "4:1", {"off the map"}},
        {door + times, "1:1", {"open field"}},
        {map + "[scene.materials]\nwood = { per_crossing = \"7 dB\" }\n", "5:8", {"grey", "door"}},
    };
    for (const Mistake& mistake : mistakes) {
        CAPTURE(mistake.text);
        try {
            const Scenario scenario = house.scenario(mistake.text + robots);
            network_settings(scenario);
            FAIL_CHECK("no error");
        } catch (const InputError& error) {
            const std::string what = error.what();
            CAPTURE(what);
            CHECK(what.find("s.toml:" + mistake.where + ":") != std::string::npos);
            for (const std::string& word : mistake.words)
                CHECK(what.find(word) != std::string::npos);
        }
    }
}

TEST_CASE(
    "door: a robot in a door that is closed at the start is refused, like a robot in a wall") {
    const House house;
    const std::string text =
        map + door + "closes = [\"0 s\"]\n[[robot]]\nname = \"a\"\nat = [\"4.5 m\", \"2.5 m\"]\n";
    const Scenario scenario = house.scenario(text);
    Network network(network_settings(scenario));
    CHECK_THROWS_AS(populate(network, scenario), InputError);
}

}  // namespace door_table_test
