// SPDX-License-Identifier: MIT
// Validations with few samples: their promises, and what they are made of.
#include "scene/scene.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/cases/naive_walls.hpp"
#include "study/validation/cases/validation_scene.hpp"
#include "study/validation/validation_charts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace validation_test {
using namespace rovernet;

namespace {

constexpr ValidationSize few{.quick = true};

std::vector<double> errors_of(const ValidationChart& chart) {
    std::vector<double> out;
    for (const ValidationPanel& panel : chart.panels) {
        for (const ValidationPoint& point : panel.points) out.push_back(point.error);
    }
    return out;
}

void check_kept(const Promises& promises) {
    CHECK(!promises.empty());
    for (const Promise& promise : promises) {
        CAPTURE(promise.what);
        CAPTURE(promise.worst);
        CHECK(promise.n > 0);
        CHECK(promise.kept());
    }
}

/// Cells that are joined to the first free one by free ones.
std::size_t joined_cells(const OccupancyGrid& map) {
    std::vector<Cell> left = map.cells;
    std::vector<std::size_t> next{
        static_cast<std::size_t>(std::find(left.begin(), left.end(), Cell::free) - left.begin())};
    const auto columns = static_cast<std::size_t>(map.columns);
    std::size_t count = 0;
    while (!next.empty()) {
        const std::size_t i = next.back();
        next.pop_back();
        if (left[i] != Cell::free) continue;
        left[i] = Cell::occupied;
        ++count;
        for (const std::size_t j : {i - 1, i + 1, i - columns, i + columns}) {
            if (j < left.size()) next.push_back(j);
        }
    }
    return count;
}

}  // namespace

TEST_CASE(
    "validation: losses, bit error rates and antenna gains equal closed forms to the claimed "
    "digits") {
    Promises promises;
    check_closed_forms(promises);
    check_kept(promises);
}

TEST_CASE("validation: walls, doors and floors are counted correctly") {
    Promises promises;
    check_counts(promises);
    CHECK(promises.size() == 2);
    check_kept(promises);
}

TEST_CASE(
    "validation: sums over rays, fits, shadowing and fading agree with brute force within the "
    "limits") {
    Promises promises;
    check_by_brute_force(promises);
    check_kept(promises);
}

TEST_CASE(
    "validation: throughput and collisions of saturated stations, and the times at which stations "
    "access the channel, agree with theory") {
    Promises promises;
    check_access(promises);
    CHECK(promises.size() == 3);
    check_kept(promises);
}

TEST_CASE("validation: positions of robots agree with closed forms") {
    Promises promises;
    check_motion(promises);
    CHECK(promises.size() == 4);
    check_kept(promises);
    // Each robot is a sample: the mean is not met to the last digit.
    CHECK(promises[0].worst > 1e-4);
    CHECK(promises[1].worst > 1e-4);
}

TEST_CASE(
    "validation: lengths of links inside walls are exact, and every approximate method has "
    "errors") {
    Promises promises;
    const ValidationChart chart = wall_length_chart(few, promises);
    check_kept(promises);
    const ValidationPanel& panel = chart.panels.front();
    CHECK(point_of(panel, "rovernet").error < 1e-6);
    CHECK(detail_of(point_of(panel, "rovernet"), "flipped decisions [%]") == 0);
    CHECK(detail_of(point_of(panel, "rovernet"), "false hits [%]") == 0);
    for (const ValidationPoint& point : panel.points) {
        if (point.label == "rovernet" || point.label == "every wall clipped") continue;
        CAPTURE(point.label);
        CHECK(point.error > 0.1);
    }
    CHECK(point_of(panel, "DDA 50 cm").error > point_of(panel, "DDA 5 cm").error);
}

TEST_CASE(
    "validation: link changes are predicted within the limits; checks at fixed time steps see them "
    "late") {
    Promises promises;
    const ValidationChart chart = link_changes_chart(few, promises);
    check_kept(promises);
    for (const ValidationPanel& panel : chart.panels) {
        CAPTURE(panel.title);
        CHECK(detail_of(panel.points.front(), "changes") > 3);
        CHECK(point_of(panel, "rovernet").error < point_of(panel, "check every 10 ms").error);
        // A change is seen half a step late on average.
        const double late = point_of(panel, "check every 100 ms").error;
        CHECK(late > 20);
        CHECK(late < 100);
    }
}

TEST_CASE(
    "validation: the decision whether a link is up is exact without logarithms, and has errors "
    "with a table of logarithms") {
    Promises promises;
    const ValidationChart chart = decisions_chart(few, promises);
    check_kept(promises);
    CHECK(promises.size() == 3);
    CHECK(point_of(chart.panels.front(), "table of 256, nearest").error > 0);
}

TEST_CASE(
    "validation: repeated measurements give equal errors of link decisions and equal delivery "
    "ratios") {
    Promises promises;
    CHECK(errors_of(decisions_chart(few, promises)) == errors_of(decisions_chart(few, promises)));
    const auto runs = [] {
        return paired_runs(office_scene(), {{"", "", {}}}, 1).front().delivery_ratio;
    };
    CHECK(runs() == runs());
}

TEST_CASE(
    "naive wall lengths: adding up cells of a raster parallel to the walls gives the exact "
    "length") {
    OccupancyGrid grid;
    grid.columns = grid.rows = 8;
    grid.cells.assign(64, Cell::free);
    for (std::size_t i = 0; i < 8; ++i)
        grid.cells[8 * i + 3] = grid.cells[8 * i + 5] = Cell::occupied;
    const Scene scene(grid);
    const NaiveRaster raster({0, 0}, {8, 8}, 1, [&](Vec3 p) { return scene.occupied(p); });
    for (const auto& [a, b] : {std::pair{Vec3{0.3, 0.2}, Vec3{7.6, 6.9}},
                               {Vec3{7.5, 1.5}, Vec3{0.5, 1.5}},
                               {Vec3{3.5, 0.5}, Vec3{3.5, 7.5}}}) {
        const double exact = scene.wall_length(a, b);
        CHECK(std::abs(raster.traversed(a, b) - exact) < 1e-12);
        CHECK(std::abs(sampled_wall(a, b, 1e-3, [&](Vec3 p) { return scene.occupied(p); }) -
                       exact) < 5e-3);
    }
    // Eight cells, two of them wall, along 7 m.
    CHECK(std::abs(raster.bresenham({0.5, 1.5}, {7.5, 1.5}) - 7.0 * 2 / 8) < 1e-12);
}

TEST_CASE("drawn maps: all rooms of the office, and all chambers of the cave, are connected") {
    const DrawnBuilding office = drawn_office();
    const OccupancyGrid rooms = drawn_map(office.width, office.depth, office_cell.value,
                                          [&](Vec3 p) { return office.is_wall(p); });
    const OccupancyGrid cave = drawn_map(cave_width, cave_depth, 0.2, is_rock);
    for (const OccupancyGrid& map : {rooms, cave}) {
        const auto open = std::count(map.cells.begin(), map.cells.end(), Cell::free);
        CHECK(joined_cells(map) == static_cast<std::size_t>(open));
        CHECK(static_cast<double>(open) > 0.2 * static_cast<double>(map.cells.size()));
    }
}

}  // namespace validation_test
