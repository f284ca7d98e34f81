// SPDX-License-Identifier: MIT
#include "experiment/reports/link_gaps.hpp"

#include "experiment/reports/link_history.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace link_gaps_test {
using namespace rovernet;

namespace {

/// A time of a link change is exact to the nanosecond; places and paths follow from it.
constexpr double tolerance = 1e-8;

bool near(double a, double b) { return std::abs(a - b) <= tolerance; }

/// A rover drives from 0 m to 100 m and back at 1 m/s. Access points are heard within 40 m.
const std::string corridor = R"([scenario]
duration = "200 s"
[propagation]
model = "disc"
range = "40 m"
[[robot]]
name = "west"
at = ["0 m", "0 m"]
[[robot]]
name = "east"
at = ["100 m", "0 m"]
[[robot]]
name = "rover"
at = ["0 m", "3 m"]
move = { model = "patrol", path = [["100 m", "3 m"], ["0 m", "3 m"]], speed = "1 m/s" }
)";

Scenario read(const test::TemporaryFolder& folder, const std::string& text) {
    return load_scenario(folder.write("s.toml", text), {});
}

}  // namespace

TEST_CASE(
    "link gaps: a robot has a gap where both access points are out of range, on its way there and "
    "back") {
    const test::TemporaryFolder folder;
    const Scenario s = read(folder, corridor);
    const double heard = std::sqrt(40.0 * 40.0 - 3.0 * 3.0);  // [m] along the corridor
    const LinkGaps gaps = link_gaps(s, {.robot = "rover", .partners = {"west", "east"}});
    REQUIRE(gaps.gaps.size() == 2);
    const LinkGap& there = gaps.gaps[0];
    const LinkGap& back = gaps.gaps[1];
    CHECK(near(seconds(there.begin), heard));
    CHECK(near(seconds(there.end), 100 - heard));
    CHECK(near(there.from.x, heard));
    CHECK(near(there.to.x, 100 - heard));
    CHECK(near(there.to.y, 3));
    CHECK(near(there.path, 100 - 2 * heard));
    CHECK(near(seconds(back.begin), 100 + heard));
    CHECK(near(back.from.x, 100 - heard));
    CHECK(near(seconds(gaps.present), 200));
    CHECK(near(gaps.path, 200));
    CHECK(near(gaps.lost_share(), (100 - 2 * heard) / 100));
    CHECK(near(gaps.lost_path(), 200 - 4 * heard));
}

TEST_CASE("link gaps: a turn of the path does not divide a gap") {
    const test::TemporaryFolder folder;
    const LinkGaps gaps =
        link_gaps(read(folder, corridor), {.robot = "rover", .partners = {"west"}});
    REQUIRE(gaps.gaps.size() == 1);
    CHECK(near(seconds(gaps.lost()), 200 - 2 * std::sqrt(40.0 * 40.0 - 3.0 * 3.0)));
}

TEST_CASE(
    "link gaps: a relay closes a gap only if it is named as a relay and is linked to an access "
    "point") {
    const test::TemporaryFolder folder;
    const auto with_relay = [&](const std::string& x) {
        return read(folder,
                    corridor + "[[robot]]\nname = \"relay\"\nat = [\"" + x + " m\", \"0 m\"]\n");
    };
    const LinkGapsQuestion alone{.robot = "rover", .partners = {"west"}};
    const LinkGapsQuestion mesh{.robot = "rover", .partners = {"west"}, .relays = {"relay"}};
    const double heard = std::sqrt(40.0 * 40.0 - 3.0 * 3.0);
    CHECK(near(seconds(link_gaps(with_relay("40"), alone).lost()), 200 - 2 * heard));
    CHECK(near(seconds(link_gaps(with_relay("40"), mesh).lost()), 2 * (60 - heard)));
    CHECK(near(seconds(link_gaps(with_relay("50"), mesh).lost()), 200 - 2 * heard));
}

TEST_CASE("link gaps: where only one direction of a link works, the robot has a gap") {
    const test::TemporaryFolder folder;
    const Scenario s =
        read(folder, corridor + "propagation = { model = \"disc\", range = \"10 m\" }\n");
    const LinkGaps gaps = link_gaps(s, {.robot = "rover", .partners = {"west"}});
    REQUIRE(gaps.gaps.size() == 1);
    CHECK(near(gaps.gaps[0].from.x, std::sqrt(10.0 * 10.0 - 3.0 * 3.0)));
}

TEST_CASE(
    "link gaps: a gap continues while the robot is off, and ends when the robot leaves the "
    "scenario") {
    const test::TemporaryFolder folder;
    const Scenario off = read(folder, corridor + "off = [\"10 s\"]\non = [\"15 s\"]\n");
    const LinkGaps gaps = link_gaps(off, {.robot = "rover", .partners = {"west"}});
    REQUIRE(gaps.gaps.size() == 2);
    CHECK(near(seconds(gaps.gaps[0].length()), 5));
    CHECK(near(gaps.gaps[0].path, 0));  // a robot that is off stands

    folder.write(
        "walk.xml",
        "<fcd-export><timestep time=\"10\"><vehicle id=\"v\" x=\"900\" y=\"0\"/></timestep>"
        "<timestep time=\"20\"><vehicle id=\"v\" x=\"910\" y=\"0\"/></timestep>"
        "<timestep time=\"30\"/></fcd-export>");
    const Scenario left = read(folder, corridor + "[movement]\nfile = \"walk.xml\"\n");
    const LinkGaps vehicle = link_gaps(left, {.robot = "v", .partners = {"west"}});
    REQUIRE(vehicle.gaps.size() == 1);
    CHECK(near(seconds(vehicle.present), 10));
    CHECK(link_gaps_text({.robot = "v", .partners = {"west"}}, {}) ==
          "v is not present during the run");
    CHECK(near(vehicle.lost_share(), 1));
}

TEST_CASE("link gaps: a gap begins and ends at the times and positions in the history of links") {
    const test::TemporaryFolder folder;
    const Scenario s = read(folder, corridor);
    const LinkGaps gaps = link_gaps(s, {.robot = "rover", .partners = {"west"}});
    std::vector<LinkHistoryRow> rows;
    for_each_link_change(s, "rover", [&](const LinkHistoryRow& row) {
        CHECK(row.to == "rover");
        if (row.from == "west") rows.push_back(row);
    });
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].is_up);
    CHECK_FALSE(rows[1].is_up);
    CHECK(rows[1].time == gaps.gaps[0].begin);
    CHECK(rows[1].to_at == gaps.gaps[0].from);
    CHECK(rows[1].from_at == Vec3{});
    CHECK(rows[2].time == gaps.gaps[0].end);
    CHECK(rows[2].to_at == gaps.gaps[0].to);
}

TEST_CASE(
    "link gaps: an access point that is unknown, named twice or the robot itself is an error") {
    const test::TemporaryFolder folder;
    const Scenario s = read(folder, corridor);
    CHECK_THROWS_AS(link_gaps(s, {.robot = "rover", .partners = {"wst"}}), std::invalid_argument);
    CHECK_THROWS_AS(link_gaps(s, {.robot = "rover", .partners = {"west", "west"}}), InputError);
    CHECK_THROWS_AS(link_gaps(s, {.robot = "rover", .partners = {"rover"}}), InputError);
}

}  // namespace link_gaps_test
