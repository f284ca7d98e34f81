// SPDX-License-Identifier: MIT
// draw --trails --margin-to: trails in the look of links, with their gaps.
#include "experiment/build.hpp"
#include "pictures/draw/color.hpp"
#include "pictures/map/link_grades.hpp"
#include "pictures/map/margin_survey.hpp"
#include "pictures/map/picture.hpp"
#include "pictures/map/trail.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace margin_trails_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// A rover drives from 1 m to 101 m at 1 m/s. In free space the link to "west", at 0 m, has a
/// margin of 40 dB at 1 m, which is 0 at 100 m: 20 dB less for each factor of 10.
const std::string road = R"([scenario]
duration = "100 s"
[radio]
frequency = "2450 MHz"
power = "0 dBm"
sensitivity = "-80.231 dBm"
[[robot]]
name = "west"
at = ["0 m", "0 m"]
[[robot]]
name = "rover"
at = ["1 m", "0 m"]
move = { model = "goal", to = ["101 m", "0 m"], speed = "1 m/s" }
)";
const std::string relay = "[[robot]]\nname = \"relay\"\nat = [\"50 m\", \"0 m\"]\n";

Scenario read(const std::string& text) {
    return read_scenario(parse_toml(text, "p.toml"), "p.toml");
}

std::vector<MarginPiece> pieces_of(const std::string& text, bool over_relay) {
    const Scenario s = read(text);
    Network network(network_settings(s));
    populate(network, s);
    std::vector<NodeId> relays;
    if (over_relay) relays.push_back(robot_named(network, "relay"));
    MarginSurvey survey(network, {robot_named(network, "west")}, relays);
    survey.run_until(start_of_run + s.scenario.duration);
    CHECK(survey.pieces(robot_named(network, "west")).empty());
    return survey.pieces(robot_named(network, "rover"));
}

bool has(std::string_view text, std::string_view word) { return text.find(word) != text.npos; }

}  // namespace

TEST_CASE(
    "margins: on a straight road the colour of a trail changes at the distances given by "
    "free-space loss") {
    const auto pieces = pieces_of(road, false);
    constexpr double sampling = 100.0 / 4000 + 1e-9;  // [s], or 1 m/s times that [m]
    constexpr double sensitivity_digit = 0.006;       // [m] by 0.0005 dB of the road's sensitivity
    REQUIRE(pieces.size() == link_grades.size() + 1);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        CHECK(pieces[i].grade == link_grades.size() - 1 - i);
        CHECK(pieces[i].end == pieces[i + 1].begin);
        const double ends_at = std::pow(10, (40 - link_grades[*pieces[i].grade].from) / 20);
        CHECK(std::abs(1 + seconds(pieces[i].end) - ends_at) < sampling + sensitivity_digit);
    }
    CHECK_FALSE(pieces.back().grade);
    CHECK(seconds(pieces.back().end) == 100);
}

TEST_CASE("margins: a link over a relay has the margin of its weakest hop") {
    const auto pieces = pieces_of(road + relay, true);
    // From 50 m on, the hop from the relay to "west" is the weakest: 20 log10(100 / 50) = 6.02 dB.
    for (const MarginPiece& piece : pieces) {
        REQUIRE(piece.grade);
        if (piece.end > start_of_run + 32s) CHECK(link_grades[*piece.grade].from == 5);
    }
    CHECK_FALSE(pieces_of(road + relay, false).back().grade);
}

TEST_CASE(
    "margins: a trail has a line for each grade of margin and a hollow line for a gap, with a "
    "legend") {
    PictureOptions options{.at = start_of_run + 100s, .trails = true, .margin_to = {"west"}};
    const std::string svg = draw_svg(read(road), options);
    for (const LinkGrade& grade : link_grades) {
        CHECK(has(svg, "stroke=\"" + hex(ember.at(grade.shade)) + "\""));
        CHECK(has(svg, std::string(">") + grade.text + "<"));
    }
    CHECK(has(svg, "link margin to west:"));
    CHECK(has(svg, ">no link to west<"));
    CHECK(has(svg, "rover has no link to west for 1.0"));
    const std::size_t margins = svg.find("class=\"margins\"");
    REQUIRE(margins != svg.npos);
    const std::string lines = svg.substr(margins, svg.find("</g>", margins) - margins);
    CHECK(has(lines, "stroke-width=\"7\""));  // the dark edge of the gap, and its white core
    CHECK(has(lines, "stroke=\"#ffffff\" stroke-width=\"4\""));
    CHECK_FALSE(has(svg, "trail in the robot's colour"));

    options.margin_to = {};
    CHECK_FALSE(has(draw_svg(read(road), options), "class=\"margins\""));
}

TEST_CASE(
    "margins: with the model `disc` a trail shows only where a link exists, and a long list is "
    "shortened") {
    std::string text = road + "[propagation]\nmodel = \"disc\"\nrange = \"60 m\"\n";
    for (int i = 0; i < 4; ++i) {
        text +=
            "[[robot]]\nname = \"r" + std::to_string(i) +
            "\"\nat = [\"1 m\", \"5 m\"]\nmove = { model = \"goal\", to = [\"9 m\", \"5 m\"] }\n";
    }
    const std::string svg =
        draw_svg(read(text), {.at = start_of_run + 100s, .trails = true, .margin_to = {"west"}});
    CHECK(has(svg, ">link to west<"));
    CHECK_FALSE(has(svg, "link margin"));
    CHECK(has(svg, "and 2 more robots"));
}

TEST_CASE("margins: in --margin-to, an unknown robot or a robot named twice is refused") {
    const PictureOptions unknown{.trails = true, .margin_to = {"wst"}};
    CHECK_THROWS_WITH_AS(draw_svg(read(road), unknown), doctest::Contains("\"west\""),
                         std::invalid_argument);
    const PictureOptions twice{.trails = true, .margin_to = {"west", "west"}};
    CHECK_THROWS_WITH_AS(draw_svg(read(road), twice), doctest::Contains("--margin-to west,west"),
                         InputError);
}

TEST_CASE("margins: a trail between two times can begin and end between two corners of the path") {
    const Scenario s = read(road);
    Network network(network_settings(s));
    const auto trails = std::make_shared<Trails>();
    network.add_sink(trails);
    populate(network, s);
    network.run_until(start_of_run + 90s);
    using Ways = std::vector<std::vector<Vec3>>;
    const NodeId rover = robot_named(network, "rover");
    CHECK(trails->ways(rover, start_of_run + 10s, start_of_run + 12s) == Ways{{{11, 0}, {13, 0}}});
    CHECK(trails->ways(rover, start_of_run, start_of_run + 12s) == Ways{{{1, 0}, {13, 0}}});
}

}  // namespace margin_trails_test
