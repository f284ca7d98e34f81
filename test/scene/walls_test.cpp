// SPDX-License-Identifier: MIT
// Walls that a segment passes, against how many were drawn.
#include "scene/doors.hpp"
#include "scene/redrawing.hpp"
#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace walls_test {
using namespace rovernet;
using test::Draw;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double side = 14;  // of the maps [m]

/// Box [m] about the middle of the map, along the walls.
struct Box {
    double x0, y0, x1, y1;
    bool contains(double x, double y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

/// Walls that stand at an angle to the cells of their map, drawn by the middles of the cells.
struct Drawing {
    double angle;  // [rad]
    std::vector<Box> walls;

    /// Point of the map by its place along and across the walls [m].
    Vec3 point(double x, double y) const {
        const double c = std::cos(angle), s = std::sin(angle);
        return {side / 2 + c * x - s * y, side / 2 + s * x + c * y, 0};
    }
    OccupancyGrid map(double cell) const {
        OccupancyGrid grid;
        grid.columns = grid.rows = static_cast<int>(std::round(side / cell));
        grid.cell_width = grid.cell_height = cell;
        const double c = std::cos(angle), s = std::sin(angle);
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const double u = (column + 0.5) * cell - side / 2;
                const double v = (row + 0.5) * cell - side / 2;
                const double x = c * u + s * v, y = c * v - s * u;
                const bool wall = std::any_of(walls.begin(), walls.end(),
                                              [&](const Box& b) { return b.contains(x, y); });
                grid.cells.push_back(wall ? Cell::occupied : Cell::free);
            }
        return grid;
    }
};

/// Rays through the middle of a wall along x, by the angle between the ray and the wall; their ends
/// are clear of it.
void for_each_ray(const Drawing& drawing, double thick,
                  const std::function<void(double grazing, Vec3 a, Vec3 b)>& visit) {
    Draw draw(3);
    for (const double grazing : {90, 60, 30, 20, 15, 10, 8, 6, 5, 4, 3, 2})
        for (int k = 0; k < 6; ++k) {
            const double along = std::cos(grazing * degree), across = std::sin(grazing * degree);
            const double x = draw.uniform(-0.7, 0.7), half = (thick / 2 + 0.12) / across;
            visit(grazing, drawing.point(x - half * along, -half * across),
                  drawing.point(x + half * along, half * across));
        }
}

const std::vector<double> angles{0, 1, 3, 7, 12, 20, 26.565, 33, 40, 45, 52, 61, 70, 83, 89.5};

}  // namespace

TEST_CASE("walls: a straight wall counts as one wall, at any angle, also for grazing rays") {
    const double thick = 0.15;  // [m]
    int in_parts = 0;
    for (const double angle : angles)
        for (const double cell : {0.02, 0.05, 0.1}) {
            const Drawing drawing{angle * degree, {{-5.5, -thick / 2, 5.5, thick / 2}}};
            const Scene scene(drawing.map(cell));
            for_each_ray(drawing, thick, [&](double grazing, Vec3 a, Vec3 b) {
                CAPTURE(angle);
                CAPTURE(cell);
                CAPTURE(grazing);
                const auto walls = scene.walls(a, b);
                REQUIRE(walls.size() == 1);
                CHECK(walls[0].thickness.value >= 0.1);
                CHECK(walls[0].length == doctest::Approx(scene.wall_length(a, b)));
                CHECK(scene.walls(b, a).size() == 1);
                in_parts += scene.crossings(a, b).size() > 1;
            });
        }
    CHECK(in_parts > 100);  // the cells alone would tell otherwise
}

TEST_CASE(
    "walls: touching only the stepped edge of a slanted wall does not count as crossing a wall") {
    int touching = 0;
    for (const double angle : {7.0, 20.0, 33.0, 52.0}) {
        const double cell = 0.05, thick = 0.15;
        const Drawing drawing{angle * degree, {{-5.5, -thick / 2, 5.5, thick / 2}}};
        const Scene scene(drawing.map(cell));
        for (double y = thick / 2; y < thick / 2 + 2 * cell; y += 0.004) {
            const Vec3 a = drawing.point(-4, y), b = drawing.point(4, y + 0.3);
            if (scene.occupied(a)) continue;
            CAPTURE(angle);
            CAPTURE(y);
            CHECK(scene.walls(a, b).empty());
            touching += !scene.crossings(a, b).empty();
        }
    }
    CHECK(touching > 10);
}

TEST_CASE("walls: two parallel walls 12 cm apart count as two, at any angle") {
    for (const double angle : angles)
        for (const double cell : {0.02, 0.05}) {
            const double apart = 0.12, thick = 0.15;  // [m]
            const double inner = apart / 2, outer = apart / 2 + thick;
            const Drawing drawing{angle * degree,
                                  {{-5.5, -outer, 5.5, -inner}, {-5.5, inner, 5.5, outer}}};
            const Scene scene(drawing.map(cell));
            for_each_ray(drawing, 2 * outer, [&](double grazing, Vec3 a, Vec3 b) {
                if (grazing < 4) return;  // as long as the walls
                CAPTURE(angle);
                CAPTURE(cell);
                CAPTURE(grazing);
                CHECK(scene.walls(a, b).size() == 2);
            });
        }
}

TEST_CASE("walls: if walls are parallel to the cells, each crossing counts as a separate wall") {
    // Rooms of 2 m with doors and corners, and two walls a cell apart, in cells of 10 cm.
    Drawing office{0, {}};
    for (const double at : {-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0}) {
        office.walls.push_back({at, -6, at + 0.1, 0.6});
        office.walls.push_back({at, 1.5, at + 0.1, 6});
        office.walls.push_back({-6, at, 0.6, at + 0.1});
        office.walls.push_back({1.5, at, 6, at + 0.1});
    }
    for (const double at : {-6.0, -4.0, 2.0, 4.0})  // beside a wall, the way between is open
        office.walls.push_back({at + 0.2, -5.5, at + 0.3, -4.5});
    const Scene scene(office.map(0.1));
    Draw draw(11);
    int near = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a{draw.uniform(0, side), draw.uniform(0, side)};
        const Vec3 b{draw.uniform(0, side), draw.uniform(0, side)};
        const auto crossings = scene.crossings(a, b);
        for (std::size_t k = 1; k < crossings.size(); ++k)
            near += crossings[k].entry - crossings[k - 1].exit < 0.2;
        CHECK(scene.walls(a, b).size() == crossings.size());
    }
    CHECK(near > 100);
}

TEST_CASE("walls: a wall drawn as an outline counts as one wall, with its drawn thickness") {
    int hollow = 0;
    for (const double thick : {0.15, 0.3})
        for (const double angle : angles)
            for (const double cell : {0.02, 0.05}) {
                const Drawing drawing{angle * degree, {{-5.5, -thick / 2, 5.5, thick / 2}}};
                const OccupancyGrid filled = drawing.map(cell), outline = outline_walls(filled);
                hollow += outline.cells != filled.cells;
                const Scene scene(outline);
                for_each_ray(drawing, thick, [&](double grazing, Vec3 a, Vec3 b) {
                    CAPTURE(thick);
                    CAPTURE(angle);
                    CAPTURE(cell);
                    CAPTURE(grazing);
                    const auto walls = scene.walls(a, b);
                    REQUIRE(walls.size() == 1);
                    CHECK(walls[0].thickness.value > thick - 1.5 * cell);
                });
            }
    CHECK(hollow > 45);  // of 60; others are too thin
}

TEST_CASE(
    "walls: two lines that outline a wall of a room count as one wall, two lines with open ends as "
    "two walls") {
    for (const double angle : {0.0, 20.0}) {
        Drawing room{angle * degree,
                     {{-4, -3, 4, -2.8}, {-4, 2.8, 4, 3}, {-4, -3, -3.8, 3}, {3.8, -3, 4, 3}}};
        const Scene rings(outline_walls(room.map(0.05)));
        CHECK(rings.walls(room.point(0.3, -5), room.point(0.1, 0)).size() == 1);
        CHECK(rings.walls(room.point(0.3, -5), room.point(0.1, 5)).size() == 2);
        CHECK(rings.walls(room.point(-5, 0.3), room.point(0, 0.5)).size() == 1);
        // Two walls of a stroke each, with a way between them.
        const Drawing open{angle * degree, {{-4, -0.1, 4, -0.05}, {-4, 0.05, 4, 0.1}}};
        const Scene lane(open.map(0.05));
        CHECK(lane.walls(open.point(0.3, -1), open.point(0.1, 1)).size() == 2);
        // A cavity that is closed, between walls and not between strokes.
        const Drawing closed{angle * degree,
                             {{-4, -0.25, 4, -0.05},
                              {-4, 0.05, 4, 0.25},
                              {-4, -0.25, -3.8, 0.25},
                              {3.8, -0.25, 4, 0.25}}};
        const Scene cavity(closed.map(0.05));
        CHECK(cavity.walls(closed.point(0.3, -1), closed.point(0.1, 1)).size() == 2);
    }
}

TEST_CASE("walls: a gap that ends at the border of the map is not the inside of a wall") {
    const std::vector<std::string> across(6, "...#..#...");
    CHECK(Scene(test::drawn_map(across, 0.1)).walls({0.05, 0.3}, {0.95, 0.35}).size() == 2);
    std::vector<std::string> closed = across;
    closed[1] = closed[4] = "...####...";
    CHECK(Scene(test::drawn_map(closed, 0.1)).walls({0.05, 0.3}, {0.95, 0.35}).size() == 1);
}

TEST_CASE(
    "walls: a closed door counts as a separate wall, and the wall beside it still as one wall") {
    const double thick = 0.15;
    const Drawing drawing{20 * degree,
                          {{-5.5, -thick / 2, -0.5, thick / 2}, {0.5, -thick / 2, 5.5, thick / 2}}};
    const Scene open(drawing.map(0.05));
    Door door{.from = drawing.point(-0.5, 0), .to = drawing.point(0.5, 0)};
    const Scene closed = with_closed(open, std::vector{door});
    const auto through = [&](const Scene& scene, double x, double grazing) {
        const double half = 0.3 / std::sin(grazing * degree);
        const double along = half * std::cos(grazing * degree);
        return scene.walls(drawing.point(x - along, -0.3), drawing.point(x + along, 0.3)).size();
    };
    CHECK(through(open, 0, 80) == 0);
    CHECK(through(closed, 0, 80) == 1);
    for (const double grazing : {60, 20, 10, 8})
        for (const double x : {-2.7, 2.8, 3.1}) {
            CHECK(through(open, x, grazing) == 1);
            CHECK(through(closed, x, grazing) == 1);
        }
}

TEST_CASE(
    "walls: for a ray through the stepped cells of a slanted wall, the crossing loss is added "
    "once") {
    const double thick = 0.15;
    const Drawing drawing{20 * degree, {{-5.5, -thick / 2, 5.5, thick / 2}}};
    const Scene scene(drawing.map(0.05));
    const std::vector<WallRate> rates{{11, 2}};
    std::vector<Crossing> scratch;
    for_each_ray(drawing, thick, [&](double grazing, Vec3 a, Vec3 b) {
        CAPTURE(grazing);
        const double loss = scene.wall_loss(a, b, rates, 1e9, scratch);
        CHECK(loss == doctest::Approx(11 + 2 * scene.wall_length(a, b)));
        CHECK(loss == scene.wall_loss(b, a, rates, 1e9, scratch));
    });
}

}  // namespace walls_test
