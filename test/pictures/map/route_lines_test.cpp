// SPDX-License-Identifier: MIT
#include "pictures/map/route_lines.hpp"

#include "pictures/map/picture.hpp"
#include "scenario/document/toml.hpp"
#include "test/pictures/draw/svg_elements.hpp"
#include "test/pictures/draw/well_formed.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace route_lines_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Five robots in a row, each in range of its neighbours; n3 is switched off at 6.9 s.
/// @param more  further tables of the scenario file
Scenario row(const std::string& protocol = "aodv", const std::string& more = "") {
    std::string text = R"([scenario]
duration = "9 s"
[propagation]
model = "disc"
range = "250 m"
[routing]
protocol = ")" + protocol +
                       R"("
[[traffic]]
kind = "unicast"
from = "n0"
to = "n4"
size = "64 B"
start = "1 s"
every = "250 ms"
)";
    for (int i = 0; i < 5; ++i) {
        text += fmt::format("[[robot]]\nname = \"n{}\"\nat = [\"{} m\", \"0 m\"]\n{}", i, 200 * i,
                            i == 3 ? "off = [\"6.9 s\"]\n" : "");
    }
    return read_scenario(parse_toml(text + more, "s.toml"), "s.toml");
}

std::string drawn(Duration at, bool route, bool search) {
    PictureOptions options{.at = start_of_run + at, .search = search};
    if (route) options.route = PictureOptions::Route{"n0", "n4"};
    const std::string svg = draw_svg(row(), options);
    CHECK(xml_fault(svg) == "");
    return svg;
}

std::vector<SvgElement> in_group(const std::string& svg, const std::string& group,
                                 const std::string& name) {
    auto all = svg_elements(svg);
    std::erase_if(all, [&](const SvgElement& e) { return e.group != group || e.name != name; });
    return all;
}

bool is_dashed(const SvgElement& path) {
    const auto dashes = path.attributes.find("stroke-dasharray");
    return dashes != path.attributes.end() && dashes->second != "none";
}

bool has(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "route lines: a route is drawn as an arrow for each hop, with the age of the route at this "
    "hop") {
    const std::string svg = drawn(5s, true, false);
    const auto paths = in_group(svg, "route", "path");
    CHECK(paths.size() == 4 * 3);  // a white line, a line and a head
    CHECK(in_group(svg, "route", "text").size() == 4);
    CHECK(in_group(svg, "route", "circle").empty());
    CHECK(has(svg, "route from n0 to n4: n0 &gt; n1 &gt; n2 &gt; n3 &gt; n4, 4 hops"));
    CHECK(has(svg, "hop of the route"));
    CHECK_FALSE(has(svg, "breaks off"));
    CHECK_FALSE(has(svg, "request"));
    CHECK(std::ranges::none_of(paths, is_dashed));
}

TEST_CASE(
    "route lines: a hop whose receiver does not hear the sender is dashed, and the route is drawn "
    "no further") {
    const std::string svg = drawn(6950ms, true, false);  // before anybody has noticed
    CHECK(has(svg, "breaks off at n2: n3 is off"));
    const auto paths = in_group(svg, "route", "path");
    CHECK(std::ranges::count_if(paths, is_dashed) == 1);
    CHECK(in_group(svg, "route", "circle").size() == 1);
    CHECK(has(svg, "hop whose next robot does not hear the sender"));
    CHECK(has(svg, "the route breaks off here"));
}

TEST_CASE(
    "route lines: each robot that sent or forwarded the last route request is drawn with a ring") {
    const std::string early = drawn(500ms, false, true);
    CHECK(in_group(early, "search", "circle").empty());
    CHECK(has(early, "no route request so far"));
    const std::string svg = drawn(5s, false, true);
    // n3 answers for n4, or n4 itself does: it sends no request.
    const auto rings = in_group(svg, "search", "circle");
    CHECK(rings.size() >= 3);
    CHECK(rings.size() <= 4);
    CHECK(has(svg, fmt::format("last route request of n0: sent by {} robots from ", rings.size())));
    CHECK(has(svg, "sent the last request"));
}

TEST_CASE(
    "route lines: with DSR, packets of several robots for the same search are drawn as one "
    "search") {
    PictureOptions options{.at = start_of_run + 5s, .search = true};
    const std::string svg = draw_svg(row("dsr"), options);
    CHECK(in_group(svg, "search", "circle").size() == 4);  // all but the target
    CHECK(has(svg, "last route request of n0: sent by 4 robots from "));
}

// Requests of n0 and of n4 for n5, which nobody reaches, cross in the middle of the row.
TEST_CASE("route lines: two simultaneous route searches are not mixed up") {
    for (const char* protocol : {"aodv", "dsr"}) {
        CAPTURE(protocol);
        PictureOptions options{.at = start_of_run + 3500ms, .search = true};
        options.route = PictureOptions::Route{"n0", "n5"};
        const std::string svg = draw_svg(row(protocol, R"(
[[traffic]]
kind = "unicast"
from = "n0"
to = "n5"
size = "64 B"
start = "1 s"
[[traffic]]
kind = "unicast"
from = "n4"
to = "n5"
size = "64 B"
start = "1 s"
[[robot]]
name = "n5"
at = ["9 km", "0 m"]
)"),
                                         options);
        CHECK(has(svg, "last route request of n0: sent by 5 robots from "));
    }
}

TEST_CASE("route lines: a route to an unknown robot is refused") {
    PictureOptions options{.route = PictureOptions::Route{"n0", "n9"}};
    CHECK_THROWS_AS(draw_svg(row(), options), std::invalid_argument);
}

}  // namespace route_lines_test
