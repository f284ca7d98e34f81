// SPDX-License-Identifier: MIT
#include "pictures/map/coverage.hpp"

#include "experiment/build.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/log_distance.hpp"
#include "scenario/document/toml.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace coverage_test {
using namespace rovernet;

namespace {

const std::string office_folder = ROVERNET_EXAMPLES "/rescue/";

Scenario office(const std::string& robots) {
    const std::string text =
        "[scene]\nmap = \"map.yaml\"\n"
        "[propagation]\nmodel = \"raytrace_2007\"\nwall_factor = 0.3\n"
        "[[robot]]\nname = \"A\"\nat = [\"24 m\", \"12 m\"]\n" +
        robots;
    const std::string file = office_folder + "test.toml";
    return read_scenario(parse_toml(text, file), file);
}

Scenario field(const std::string& text) {
    return read_scenario(parse_toml(text, "f.toml"), "f.toml");
}

struct Built {
    explicit Built(const Scenario& s) : network(network_settings(s)) {
        populate(network, s);
        network.run_until(start_of_run);
    }
    Network network;
};

constexpr NodeId first{0};

}  // namespace

TEST_CASE(
    "coverage: the level of a cell equals the power that a robot there receives, also behind "
    "walls") {
    const Scenario alone = office("");
    Built built(alone);
    const Transmitter a = transmitter(built.network, first, start_of_run);
    const CoverageMap map = coverage(a, {0, 0}, {48, 24}, 800);
    int compared = 0, walled = 0;
    for (int i = 0; i < map.columns * map.rows; i += 37) {
        const Vec3 p = map.centre(i % map.columns, i / map.columns);
        if (built.network.scene().clearance(p) < 0.01) continue;
        const Scenario both = office(fmt::format(
            "[[robot]]\nname = \"probe\"\nradius = \"1 mm\"\nat = [\"{} m\", \"{} m\"]\n", p.x,
            p.y));
        Built with_probe(both);
        const NodeId probe = *with_probe.network.find("probe");
        const Medium& medium = with_probe.network.medium();
        const Db loss =
            medium.links().path_loss(first, probe, start_of_run, with_probe.network.legs());
        CHECK(map.at(i % map.columns, i / map.columns) ==
              received_power(medium.stations().radio(first), medium.stations().radio(probe), loss)
                  .value);
        ++compared;
        walled += with_probe.network.scene().wall_length(a.antenna, p) > 0;
    }
    CHECK(compared > 15);
    CHECK(walled > 10);
}

TEST_CASE(
    "coverage: cells are nearly square, about as many as requested, and cover the rectangle") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .scene = &scene};
    for (const int cells : {1, 2, 100, 4999}) {
        for (const double width : {0.5, 10.0, 3000.0}) {
            const CoverageMap map = coverage(t, {-1, 2}, {-1 + width, 12}, cells);
            CHECK(map.columns * map.rows <= cells);
            CHECK(map.columns * map.rows >= cells / 2);
            CHECK(map.dbm.size() == static_cast<std::size_t>(map.columns * map.rows));
            const Vec3 last = map.centre(map.columns - 1, map.rows - 1);
            constexpr double rounding = 1e-9;
            CHECK(std::abs(last.x + map.cell_width / 2 - (-1 + width)) < rounding);
            CHECK(std::abs(last.y + map.cell_height / 2 - 12) < rounding);
        }
    }
    const CoverageMap square = coverage(t, {0, 0}, {20, 10}, 20'000);
    CHECK(square.columns == 200);
    CHECK(square.rows == 100);
}

TEST_CASE(
    "coverage: row 0 is at the bottom, and cells are at the height of the transmitter's antenna") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .antenna = {1, 1, 2.5}, .scene = &scene};
    const CoverageMap map = coverage(t, {0, 0}, {10, 10}, 100);
    CHECK(map.centre(0, 0) == Vec3{0.5, 0.5, 2.5});
    CHECK(map.at(0, 0) > map.at(0, 9));
    CHECK(map.at(0, 0) > map.at(9, 0));
}

TEST_CASE("coverage: shadowing has no effect on a coverage map, whatever its sigma is") {
    const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n";
    const Scenario shadowed =
        field("[propagation]\nmodel = \"log_distance\"\nsigma = \"8 dB\"\n" + robot);
    const Scenario flat =
        field("[propagation]\nmodel = \"log_distance\"\nsigma = \"0 dB\"\n" + robot);
    Built a(shadowed), b(flat);
    const auto map = [](const Built& built) {
        return coverage(transmitter(built.network, first, start_of_run), {-50, -50}, {50, 50}, 64)
            .dbm;
    };
    CHECK(map(a) == map(b));
    const Propagation random = a.network.medium().stations().model(first);
    CHECK(random.is_random());
    CHECK_FALSE(b.network.medium().stations().model(first).is_random());
    CHECK_FALSE(random.median().is_random());
    CHECK(random.median().as<LogDistance>()->exponent == random.as<LogDistance>()->exponent);
    CHECK(random.as<Friis>() == nullptr);
}

TEST_CASE("coverage: the key `sigma` has no effect if the chosen model does not use this key") {
    Built built(
        field("[propagation]\nmodel = \"friis\"\nsigma = \"8 dB\"\n[[robot]]\nname = \"A\"\nat = "
              "[\"0 m\", \"0 m\"]\n"));
    CHECK_FALSE(built.network.medium().stations().model(first).is_random());
}

TEST_CASE(
    "coverage: the coverage of a robot is computed with the robot's own propagation model and "
    "radio") {
    const Scenario s = field(
        "[[robot]]\nname = \"a\"\ncount = 3\nplace = { area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 "
        "m\"]] }\n[[robot]]\nname = \"d\"\ncount = 2\nradio = { power = \"1 mW\" }\n"
        "place = { area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }\n"
        "propagation = { model = \"disc\", range = \"5 m\" }\n");
    Built built(s);
    for (std::uint32_t i = 0; i < 5; ++i) {
        const Transmitter t = transmitter(built.network, NodeId{i}, start_of_run);
        CHECK(t.model.name() == (i < 3 ? "friis" : "disc"));
        CHECK(t.radio.power == built.network.medium().stations().radio(NodeId{i}).power);
        CHECK(t.antenna.z == 1);
    }
}

TEST_CASE("coverage: an empty rectangle, or an absurd number of cells, is refused") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .scene = &scene};
    CHECK_THROWS_AS(coverage(t, {0, 0}, {0, 1}, 10), std::invalid_argument);
    CHECK_THROWS_AS(coverage(t, {0, 0}, {1, 1}, 0), std::invalid_argument);
    CHECK_THROWS_AS(coverage(t, {0, 0}, {1, 1}, most_coverage_cells + 1), std::invalid_argument);
}

TEST_CASE("coverage: with two transmitters, each cell has the higher of the two levels") {
    const Scene scene;
    const Transmitter west{.model = Friis{}, .antenna = {0, 0, 1}, .scene = &scene};
    Transmitter east = west;
    east.antenna.x = 40;
    east.radio.power = Dbm{west.radio.power.value + 6};
    const CoverageMap of_west = coverage(west, {-10, -10}, {50, 10}, 300);
    const CoverageMap of_east = coverage(east, {-10, -10}, {50, 10}, 300);
    const CoverageMap best = coverage(std::array{west, east}, {-10, -10}, {50, 10}, 300);
    int from_west = 0;
    for (std::size_t i = 0; i < best.dbm.size(); ++i) {
        CHECK(best.dbm[i] == std::max(of_west.dbm[i], of_east.dbm[i]));
        from_west += of_west.dbm[i] > of_east.dbm[i];
    }
    // 6 dB are a factor of 2 in distance: the border is a circle of Apollonius, at x = 40 / 3.
    CHECK(from_west > 0);
    CHECK(best.at(0, best.rows / 2) == of_west.at(0, best.rows / 2));
    CHECK(best.at(best.columns / 2, best.rows / 2) == of_east.at(best.columns / 2, best.rows / 2));
}

}  // namespace coverage_test
