// SPDX-License-Identifier: MIT
// Doors in pictures: a wall while they are closed, a dashed outline while they are open.
#include "experiment/build.hpp"
#include "experiment/reports/scene_report.hpp"
#include "network/network.hpp"
#include "pictures/map/picture.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/pictures/draw/well_formed.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <variant>

namespace picture_doors_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("picture: a closed door is drawn as a wall, an open door as a dashed outline") {
    test::TemporaryFolder folder;
    folder.write("m.pgm", "P2 6 2 255\n255 255 0 150 255 255\n255 255 255 150 255 255\n");
    folder.write("m.yaml", "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
    const Scenario scenario =
        load_scenario(folder.write("s.toml",
                                   "[scene]\nmap = \"m.yaml\"\n"
                                   "[[scene.door]]\nfrom = [\"2.5 m\", \"0 m\"]\n"
                                   "to = [\"2.5 m\", \"1 m\"]\nmaterial = \"steel\"\n"
                                   "closes = [\"10 s\"]\nopens = [\"20 s\"]\n"
                                   "[scene.materials]\nsteel = { per_crossing = \"20 dB\" }\n"
                                   "[[robot]]\nname = \"a\"\nat = [\"1 m\", \"1 m\"]\n"),
                      {});
    const auto picture = [&](Duration at) {
        const std::string svg = draw_svg(scenario, {.at = start_of_run + at});
        CHECK(test::xml_fault(svg) == "");
        return svg;
    };
    for (const Duration open : {0s, 9s, 20s}) {
        const std::string svg = picture(open);
        CHECK(count(svg, "stroke-dasharray=\"3 2\"") == 2);  // and in the legend
        CHECK(count(svg, ">open door<") == 1);
        CHECK(count(svg, ">closed door<") == 0);
        CHECK(count(svg, ">steel</text>") == 0);
    }
    for (const Duration closed : {10s, 19s}) {
        const std::string svg = picture(closed);
        CHECK(count(svg, "stroke-dasharray=\"3 2\"") == 0);
        CHECK(count(svg, ">closed door<") == 1);
        CHECK(count(svg, ">steel</text>") == 1);
        CHECK(count(svg, ">unknown</text>") == 1);  // cells stay what they are
    }
}

TEST_CASE("picture, scene: stairs are drawn on both storeys that they connect, and listed once") {
    const Scenario scenario = load_scenario(ROVERNET_EXAMPLES "/storeys/storeys.toml", {});
    for (const int storey : {1, 2}) {
        PictureOptions options;
        options.storey = storey;
        CHECK(count(draw_svg(scenario, options), ">stairs, up<") == 1);
    }
    const Network network(network_settings(scenario));
    const auto stairs = stairs_of(scenario, network.scene().storeys());
    REQUIRE(stairs.size() == 1);  // up and down are the same
    CHECK(stairs[0].foot == Vec3{5.5, 8.4, 0});
    CHECK(stairs[0].head == Vec3{9.5, 8.4, 3});
    const Scenario flat = load_scenario(ROVERNET_EXAMPLES "/patrol/patrol.toml", {});
    CHECK(stairs_of(flat, Storeys()).empty());
}

TEST_CASE("scene: the report of a scene lists each door with its times and whether it is closed") {
    const Scenario scenario = load_scenario(ROVERNET_EXAMPLES "/emulate/door.toml", {});
    const Network network(network_settings(scenario));
    const auto is_closed = [&](int s) {
        Table report;
        append_doors_and_stairs(report, scenario, network.scene(),
                                start_of_run + std::chrono::seconds{s});
        CHECK_FALSE(report.find("stairs"));
        const Array& doors = *report.find("doors")->array();
        REQUIRE(doors.size() == 1);
        const Table& door = *doors[0].table();
        CHECK(*door.find("name")->string() == "office");
        CHECK(*door.find("material")->string() == "steel");
        CHECK(std::get<double>((*door.find("opens_s")->array())[0].data) == 20);
        return std::get<bool>(door.find("closed")->data);
    };
    CHECK_FALSE(is_closed(9));
    CHECK(is_closed(10));
    CHECK_FALSE(is_closed(20));
}

}  // namespace picture_doors_test
