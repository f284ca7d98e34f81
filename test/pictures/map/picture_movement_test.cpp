// SPDX-License-Identifier: MIT
// Pictures of robots that only a movement file names: all is asked of the network.
#include "pictures/map/picture.hpp"
#include "scenario/scenario_file.hpp"
#include "test/pictures/draw/svg_elements.hpp"
#include "test/pictures/draw/well_formed.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace picture_movement_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::of_class;
using test::svg_elements;
using test::SvgElement;

namespace {

bool has(std::string_view text, std::string_view word) { return text.find(word) != text.npos; }

/// Two nodes of ns-2: one stands, one goes east from t = 1 s on.
constexpr const char* two_nodes =
    "$node_(0) set X_ 0\n$node_(0) set Y_ 0\n$node_(1) set X_ 30\n$node_(1) set Y_ 0\n"
    "$ns_ at 1.0 \"$node_(1) setdest 80 0 5\"\n";

/// A vehicle from the start to 1 s, another from 2 s to 3 s.
constexpr const char* two_vehicles =
    "<fcd-export>\n"
    "<timestep time=\"0\"><vehicle id=\"early\" x=\"0\" y=\"0\"/></timestep>\n"
    "<timestep time=\"1\"><vehicle id=\"early\" x=\"10\" y=\"0\"/></timestep>\n"
    "<timestep time=\"2\"><vehicle id=\"late\" x=\"0\" y=\"40\"/></timestep>\n"
    "<timestep time=\"3\"><vehicle id=\"late\" x=\"20\" y=\"40\"/></timestep>\n"
    "</fcd-export>\n";

std::string robots(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += fmt::format(
            "[[robot]]\nname = \"own{}\"\nat = [\"{} m\", \"9 m\"]\nradius = \"1 m\"\n", i, 10 * i);
    }
    return text;
}

std::size_t circles(const std::string& svg) {
    std::size_t count = 0;
    for (const SvgElement& each : svg_elements(svg)) count += each.name == "circle";
    return count;
}

/// A scenario of its own: the file in the folder.
struct Files {
    test::TemporaryFolder folder;
    std::string nodes = folder.write("nodes.tcl", two_nodes);
    std::string vehicles = folder.write("fcd.xml", two_vehicles);

    Scenario beside(int count) {
        const std::string text = "[movement]\nfile = \"nodes.tcl\"\n" + robots(count);
        return load_scenario(folder.write(fmt::format("s{}.toml", count), text), {});
    }
};

}  // namespace

TEST_CASE(
    "picture: robots of a movement file are drawn, whether or not the scenario has tables "
    "[[robot]]") {
    Files files;
    CHECK(circles(draw_svg(load_scenario(files.nodes, {}), {.at = start_of_run + 2s})) == 2);
    for (const int own : {0, 1, 7}) {
        const Scenario s = files.beside(own);
        for (const bool everything : {false, true}) {
            const PictureOptions options{.at = start_of_run + 3s,
                                         .coverage = everything ? std::vector<std::string>{"n1"}
                                                                : std::vector<std::string>{},
                                         .links = everything,
                                         .trails = everything,
                                         .cells = 400,
                                         .axes = everything};
            const std::string svg = draw_svg(s, options);
            CHECK(test::xml_fault(svg) == "");
            // The sign of the transmitter in the legend is one more.
            CHECK(circles(svg) == static_cast<std::size_t>(2 + own + everything));
            CHECK_FALSE(has(svg, " km"));
            CHECK(has(svg, "friis"));
        }
    }
}

TEST_CASE(
    "picture: the coverage of a robot of a movement file is drawn for receivers with the same "
    "radio") {
    Files files;
    const std::string svg = draw_svg(files.beside(1), {.coverage = {"n1"}, .cells = 400});
    CHECK(has(svg, "coverage of n1: level for a radio like its own"));
    CHECK(has(svg, "sensitivity"));
}

TEST_CASE("picture: vehicles that are not present are counted and not drawn") {
    Files files;
    const Scenario s = load_scenario(files.vehicles, {});
    const std::string before = draw_svg(s, {.at = start_of_run + 500ms});
    CHECK(circles(before) == 1);
    CHECK(has(before, "of 2 robots, 1 not departed yet"));
    CHECK(has(before, ">early</text>"));
    CHECK_FALSE(has(before, ">late</text>"));
    const std::string after = draw_svg(s, {.at = start_of_run + 2500ms, .trails = true});
    CHECK(circles(after) == 1);
    CHECK(has(after, "of 2 robots, 1 already left"));
    CHECK(has(after, "<title>early</title>"));  // its trail stays
    CHECK_FALSE(has(after, ">early</text>"));
}

TEST_CASE("picture: the coverage of a robot that is absent or off is labelled with this state") {
    Files files;
    const Scenario vehicles = load_scenario(files.vehicles, {});
    const PictureOptions late{.at = start_of_run + 1s, .coverage = {"late"}, .cells = 400};
    CHECK(has(draw_svg(vehicles, late), "coverage of late (not departed yet"));
    const PictureOptions early{.at = start_of_run + 3s, .coverage = {"early"}, .cells = 400};
    CHECK(has(draw_svg(vehicles, early), "coverage of early (has left"));
    const std::string off = robots(1) + "off = [\"1 s\"]\n";
    const Scenario s = load_scenario(files.folder.write("off.toml", off), {});
    const PictureOptions options{.at = start_of_run + 2s, .coverage = {"own0"}, .cells = 400};
    CHECK(has(draw_svg(s, options), "coverage of own0 (switched off"));
    CHECK(has(draw_svg(s, {.coverage = {"own0"}, .cells = 400}), "coverage of own0: level"));
}

TEST_CASE("picture: if the time is after the end of the run, the caption says so") {
    Files files;
    const Scenario s = load_scenario(
        files.folder.write("e.toml", "[scenario]\nduration = \"5 s\"\n" + robots(1)), {});
    CHECK(has(draw_svg(s, {.at = start_of_run + 9s}), "t = 9 s, after the end of the run at 5 s"));
    CHECK_FALSE(has(draw_svg(s, {.at = start_of_run + 5s}), "after the end"));
}

TEST_CASE("picture: trails have the colours of their robots") {
    Files files;
    const std::string text = "[movement]\nfile = \"moves.tcl\"\n";
    std::string moves;
    for (int i = 0; i < 3; ++i) {
        moves += fmt::format(
            "$node_({0}) set X_ 0\n$node_({0}) set Y_ {1}\n"
            "$ns_ at 0.0 \"$node_({0}) setdest 50 {1} 5\"\n",
            i, 10 * i);
    }
    files.folder.write("moves.tcl", moves);
    const std::string svg = draw_svg(load_scenario(files.folder.write("t.toml", text), {}),
                                     {.at = start_of_run + 4s, .trails = true});
    std::vector<std::string> trails, rims;
    for (const SvgElement& each : svg_elements(svg)) {
        if (each.group == "trail" && each.name == "path" && each.attributes.at("fill") == "none") {
            trails.push_back(each.attributes.at("stroke"));
        }
        if (each.name == "circle") rims.push_back(each.attributes.at("stroke"));
    }
    CHECK(trails == std::vector<std::string>{"#0072b2", "#d55e00", "#009e73"});
    CHECK(rims == trails);
}

}  // namespace picture_movement_test
