// SPDX-License-Identifier: MIT
// Robots that do not fit at a place because the map does not know it.
#include "experiment/unknown_cells.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace unknown_cells_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

/// A map of 6 m x 2 m in cells of 1 m: free, free, free, unknown (grey 205), free, wall.
struct Map {
    TemporaryFolder folder;
    Map() {
        const std::string row = "\xff\xff\xff\xcd\xff" + std::string(1, '\0');
        folder.write("m.pgm", "P5\n6 2\n255\n" + row + row);
        folder.write("m.yaml",
                     "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    }
    Scenario scenario(const std::string& robot) const {
        return load_scenario(
            folder.write("s.toml",
                         "[scenario]\nduration = \"1 s\"\n[scene]\nmap = \"m.yaml\"\n"
                         "[[robot]]\nname = \"A\"\n" +
                             robot),
            {});
    }
    std::string error(const std::string& robot) const {
        try {
            const Session session(scenario(robot));
        } catch (const InputError& fault) {
            return fault.what();
        }
        return "no error";
    }
};

bool has(const std::string& text, const char* words) { return text.find(words) != text.npos; }

}  // namespace

TEST_CASE(
    "unknown cells: for a robot in or near an unknown cell, the error has the cell's grey level") {
    const Map map;
    const std::string in = map.error("at = [\"3.5 m\", \"1 m\"]\n");
    CHECK(has(in, "robot \"A\" at (3.5, 1) m is in an unknown cell of the map"));
    CHECK(has(in, "free_thresh of 0.197, which makes cells of grey level 205 free"));
    const std::string near = map.error("at = [\"2.9 m\", \"1 m\"]\n");
    CHECK(has(near, "is nearer to an unknown cell of the map than its radius of 0.2 m"));
    CHECK(has(near, "clearance 0.100 m"));
    CHECK(has(near, "give it a smaller radius"));
    CHECK(map.error("at = [\"2.8 m\", \"1 m\"]\n") == "no error");
    CHECK(has(map.error("at = [\"4.9 m\", \"1 m\"]\n"), "inside a wall, or nearer to a wall"));
    const std::string goal = map.error(
        "at = [\"1 m\", \"1 m\"]\nmove = { model = \"goal\", to = [\"3.5 m\", \"1 m\"] }\n");
    CHECK(has(goal, "the destination is in an unknown cell of the map"));
}

TEST_CASE(
    "unknown cells: if a wall is nearer than the unknown cell, the error is not about the cell") {
    const Map map;
    const Scenario scenario = map.scenario("at = [\"1 m\", \"1 m\"]\n");
    const Session session(scenario);
    const auto text = [&](double x, double radius) {
        return unknown_cell_text(session.network().scene(), {x, 1, 0}, {radius}, "the radius");
    };
    CHECK(text(1.5, 0.2).empty());
    CHECK(has(text(4.4, 0.7), "nearer to an unknown cell of the map than the radius of 0.7 m"));
    CHECK(text(4.6, 0.7).empty());  // the wall is nearer
    CHECK(text(5.5, 0.2).empty());
    CHECK(text(3.5, 0).empty());
    CHECK(text(-1e12, 0.2).empty());
}

}  // namespace unknown_cells_test
