// SPDX-License-Identifier: MIT
// Doors in pictures: a wall while they are closed, a dashed outline while they are open.
#include "pictures/map/picture.hpp"
#include "scenario/scenario.hpp"
#include "test/pictures/draw/well_formed.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <string>

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

TEST_CASE("picture: a door is a wall while it is closed, and a dashed outline while it is open") {
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
        CHECK(count(svg, "stroke-dasharray=\"3 2\"") == 1);
        CHECK(count(svg, ">steel</text>") == 0);
    }
    for (const Duration closed : {10s, 19s}) {
        const std::string svg = picture(closed);
        CHECK(count(svg, "stroke-dasharray=\"3 2\"") == 0);
        CHECK(count(svg, ">steel</text>") == 1);
        CHECK(count(svg, ">unknown</text>") == 1);  // cells stay what they are
    }
}

}  // namespace picture_doors_test
