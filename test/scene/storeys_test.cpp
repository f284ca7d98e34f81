// SPDX-License-Identifier: MIT
// Scenes of several storeys, each with a map of its own.
#include "scene/range_finder.hpp"
#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace storeys_test {
using namespace rovernet;
using test::drawn_map;

namespace {

/// Some roundings of coordinates up to 100 m.
constexpr double tolerance = 1e-12;  // [m]

bool near(double a, double b, double within = tolerance) { return std::abs(a - b) <= within; }

OccupancyGrid on_floor(OccupancyGrid map, double height) {
    map.origin.z = height;
    return map;
}

const std::vector<std::string> ground{"......", "..#...", "......"};
const std::vector<std::string> upper{"......", "...#..", "......"};

/// A pillar at x = 2 ... 3 below, one at x = 3 ... 4 above 3 m; both at y = 1 ... 2.
Scene two_storeys(std::vector<Material> materials = {Material{}},
                  std::vector<Material> ceilings = {}) {
    return Scene({on_floor(drawn_map(ground), 0), on_floor(drawn_map(upper), 3)},
                 std::move(materials), std::move(ceilings));
}

/// The point is in a wall, looked up in the maps that lie at z = 0, 3 and 5.
bool in_wall(const std::vector<OccupancyGrid>& maps, Vec3 p) {
    const OccupancyGrid& map = maps[p.z < 3 ? 0 : p.z < 5 ? 1 : 2];
    const int column = static_cast<int>(std::floor(p.x)), row = static_cast<int>(std::floor(p.y));
    return column >= 0 && row >= 0 && column < map.columns && row < map.rows &&
           map.at(column, row) == Cell::occupied;
}

}  // namespace

TEST_CASE("storeys: a horizontal link crosses the walls of its own storey") {
    const Scene scene = two_storeys();
    for (const double z : {-1.0, 0.0, 1.0, 2.999}) {
        const auto below = scene.crossings({0, 1.5, z}, {6, 1.5, z});
        REQUIRE(below.size() == 1);
        CHECK(near(below[0].entry, 2));
    }
    for (const double z : {3.0, 4.0, 100.0}) {
        const auto above = scene.crossings({0, 1.5, z}, {6, 1.5, z});
        REQUIRE(above.size() == 1);
        CHECK(near(above[0].entry, 3));
    }
}

TEST_CASE(
    "storeys: each part of a link between storeys crosses the walls of the storey in which it is") {
    const Scene scene = two_storeys();
    // It rises 1 m per metre and passes the ceiling at x = 3: both pillars stand in its way.
    const double slope = std::sqrt(2.0);
    CHECK(near(scene.wall_length({0, 1.5, 0}, {6, 1.5, 6}), 2 * slope));
    // A wall that goes on behind the ceiling is one wall.
    CHECK(scene.crossings({0, 1.5, 0}, {6, 1.5, 6}).size() == 1);
    // It falls: it is above the lower pillar, and below the upper one's floor at x = 3.
    CHECK(scene.wall_length({0, 1.5, 6}, {6, 1.5, 0}) == 0);
    // It passes the ceiling at x = 2.5, amid the lower pillar, and at x = 3.25.
    CHECK(near(scene.wall_length({0, 1.5, 0.5}, {6, 1.5, 6.5}), slope * 1.5));
    CHECK(near(scene.wall_length({0, 1.5, -0.25}, {6, 1.5, 5.75}), slope * 1.75));
}

TEST_CASE("storeys: the length inside walls agrees with points sampled along the link") {
    test::Draw draw(24);
    constexpr int points = 20'000;
    for (int trial = 0; trial < 30; ++trial) {
        std::vector<OccupancyGrid> maps;
        for (const double height : {0.0, 3.0, 5.0})
            maps.push_back(on_floor(test::random_map(draw, 8, 7, 20), height));
        const Scene scene(maps, {Material{}});
        const auto end = [&] {
            return Vec3{draw.uniform(-1, 9), draw.uniform(-1, 8), draw.uniform(-1, 8)};
        };
        const Vec3 a = end(), b = end();
        int inside = 0, walls = 0;
        bool was_inside = false;
        for (int i = 0; i < points; ++i) {
            const bool is_inside = in_wall(maps, a + ((i + 0.5) / points) * (b - a));
            inside += is_inside;
            walls += is_inside && !was_inside;
            was_inside = is_inside;
        }
        CAPTURE(trial);
        const double length = distance(a, b);
        const auto found = scene.crossings(a, b);
        // Each end of a crossing is known to a step between two points.
        const double within = 2 * length / points * static_cast<double>(walls + 1);
        CHECK(near(scene.wall_length(a, b), length * inside / points, within));
        const auto sampled = std::count_if(found.begin(), found.end(), [&](const Crossing& c) {
            return c.length > 2 * length / points;
        });
        CHECK(sampled <= walls);
        CHECK(static_cast<std::ptrdiff_t>(found.size()) >= walls);
    }
}

TEST_CASE(
    "storeys: wall lengths and wall losses of a link have equal bits in both of its directions") {
    test::Draw draw(25);
    const Scene scene({on_floor(test::random_map(draw, 9, 9, 15), 0),
                       on_floor(test::random_map(draw, 9, 9, 15), 2.7)},
                      {Material{}});
    const std::vector<WallRate> rates{{0.1, 7}};
    std::vector<Crossing> scratch;
    const double all = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 500; ++i) {
        const auto end = [&] {
            return Vec3{draw.uniform(0, 9), draw.uniform(0, 9), draw.uniform(0, 6)};
        };
        const Vec3 a = end(), b = end();
        CHECK(scene.wall_length(a, b) == scene.wall_length(b, a));
        CHECK(scene.wall_loss(a, b, rates, all, scratch) ==
              scene.wall_loss(b, a, rates, all, scratch));
    }
}

TEST_CASE(
    "storeys: the height of a wall is measured from the floor, and the wall ends at the ceiling") {
    const Scene low = two_storeys({Material{.height = Meters{2}}});
    CHECK(near(low.wall_length({0, 1.5, 1.9}, {6, 1.5, 1.9}), 1));
    CHECK(low.wall_length({0, 1.5, 2.1}, {6, 1.5, 2.1}) == 0);
    CHECK(near(low.wall_length({0, 1.5, 4.9}, {6, 1.5, 4.9}), 1));
    CHECK(low.wall_length({0, 1.5, 5.1}, {6, 1.5, 5.1}) == 0);
    const Scene high = two_storeys({Material{.height = Meters{4}}});
    CHECK(high.crossings({0, 1.5, 3.5}, {6, 1.5, 3.5}).size() == 1);
}

TEST_CASE("storeys: the ceilings between two heights are listed from the lowest to the highest") {
    const std::vector<OccupancyGrid> maps{on_floor(drawn_map(ground), 0),
                                          on_floor(drawn_map(ground), 3),
                                          on_floor(drawn_map(ground), 6)};
    const Scene scene(maps, {Material{}}, {{.name = "first"}, {.name = "second"}});
    CHECK(scene.storeys().size() == 3);
    CHECK(scene.storeys().floor(1) == 3);
    CHECK(scene.storeys().ceilings_between(0, 2.9).empty());
    CHECK(scene.storeys().ceilings_between(3, 5.9).empty());
    for (const auto& [from, to] : {std::pair{0.0, 3.0}, std::pair{3.0, 2.0}}) {
        REQUIRE(scene.storeys().ceilings_between(from, to).size() == 1);
        CHECK(scene.storeys().ceilings_between(from, to)[0].name == "first");
    }
    REQUIRE(scene.storeys().ceilings_between(7, -1).size() == 2);
    CHECK(scene.storeys().ceilings_between(7, -1)[1].name == "second");
    CHECK(Scene(drawn_map(ground)).storeys().ceilings_between(0, 100).empty());
    CHECK(Scene().storeys().ceilings_between(0, 100).empty());
}

TEST_CASE("storeys: a robot avoids the obstacles of its own storey") {
    const Scene scene = two_storeys();
    CHECK(near(scene.clearance({1, 1.5, 1}), 1));
    CHECK(near(scene.clearance({1, 1.5, 3}), 2));
    CHECK(scene.occupied({2.5, 1.5, 0}));
    CHECK_FALSE(scene.occupied({2.5, 1.5, 3}));
    CHECK(scene.occupied({3.5, 1.5, 3}));
    const Meters body{0.2};
    CHECK_FALSE(scene.passable({0.5, 1.5, 0}, {5.5, 1.5, 0}, body));
    CHECK(scene.passable({0.5, 1.5, 0}, {1.7, 1.5, 0}, body));
    CHECK(scene.passable({0.5, 1.5, 3}, {2.7, 1.5, 3}, body));
}

TEST_CASE(
    "storeys: on stairs, each part of the path avoids the walls of the storey in which it is") {
    const Scene scene = two_storeys();
    const Meters body{0.2};
    // Up over the lower pillar, which ends at the ceiling: blocked below, and free if the ceiling
    // is reached before.
    CHECK_FALSE(scene.passable({0.5, 1.5, 0}, {2.7, 1.5, 3}, body));
    CHECK(scene.passable({0.5, 1.5, 0}, {1.7, 1.5, 3}, body));
    CHECK(scene.passable({1.7, 1.5, 3}, {0.5, 1.5, 0}, body));
    // It passes the ceiling at x = 1.75, and stays above where the lower pillar stands.
    CHECK(scene.passable({1, 1.5, 0}, {2.5, 1.5, 6}, body));
    CHECK(scene.passable({2.5, 1.5, 6}, {1, 1.5, 0}, body));
    // The upper end stands in the upper pillar.
    CHECK_FALSE(scene.passable({5.5, 1.5, 0}, {3.9, 1.5, 3}, body));
    CHECK(scene.passable({5.5, 1.5, 0}, {4.3, 1.5, 3}, body));
}

TEST_CASE("storeys: a range finder sees the walls of its storey") {
    const RangeFinder finder{.beams = 1, .from = {0}, .to = {0}, .range = {9}};
    const Scene scene = two_storeys();
    std::vector<double> way(1);
    finder.measure(scene, {0.5, 1.5, 0.5}, {0}, {}, way);
    CHECK(near(way[0], 1.5));
    finder.measure(scene, {0.5, 1.5, 3.5}, {0}, {}, way);
    CHECK(near(way[0], 2.5));
}

TEST_CASE(
    "storeys: each storey of a scene is a scene itself, and a new scene from the same maps has the "
    "same storeys") {
    const Scene scene = two_storeys();
    CHECK(scene.storey_at(3).crossings({0, 1.5, 4}, {6, 1.5, 4})[0].entry == doctest::Approx(3));
    CHECK(scene.storey(0).storeys().size() == 1);
    CHECK(scene.storey(1).wall_thickness({3.5, 1.5, 3}).value == doctest::Approx(1));
    CHECK(scene.wall_thickness({3.5, 1.5, 3}).value == doctest::Approx(1));
    CHECK(scene.wall_thickness({3.5, 1.5, 0}).value == 0);
    REQUIRE(scene.wall_rectangles().size() == 2);
    CHECK(scene.wall_rectangles()[1].corners[0] == Vec3{3, 1, 3});
    CHECK(scene.wall_rectangles()[1].bottom == 3);
    CHECK(scene.wall_rectangles()[0].top == 3);
    CHECK(scene.occupied_cells() == 2);
    const Scene again(scene.maps(), scene.materials());
    CHECK(again.storeys().size() == 2);
    CHECK(near(again.wall_length({0, 1.5, 0.5}, {6, 1.5, 6.5}), std::sqrt(2.0) * 1.5));
    // A storey without walls stays one.
    const Scene bare({on_floor(drawn_map({"..", ".."}), 0), on_floor(drawn_map({".#", ".."}), 3)},
                     {Material{}});
    CHECK(Scene(bare.maps(), bare.materials()).storeys().size() == 2);
    CHECK(bare.with_walls_of(again).wall_length({0, 1.5, 4}, {6, 1.5, 4}) == doctest::Approx(1));
}

TEST_CASE("storeys: several maps at one floor height form one storey") {
    OccupancyGrid beside = on_floor(drawn_map(upper), 3);
    beside.origin.x = 6;
    const Scene scene({on_floor(drawn_map(ground), 0), on_floor(drawn_map(upper), 3), beside},
                      {Material{}});
    CHECK(scene.storeys().size() == 2);
    CHECK(scene.storeys().floor(1) == 3);
    CHECK(scene.crossings({0, 1.5, 4}, {12, 1.5, 4}).size() == 2);
    CHECK(scene.crossings({0, 1.5, 1}, {12, 1.5, 1}).size() == 1);
    CHECK(scene.inside_map({11, 1, 3}));
    CHECK_FALSE(scene.inside_map({11, 1, 0}));
}

TEST_CASE("storeys: a wrong number of ceilings, and a floor height of NaN, are refused") {
    CHECK_THROWS_AS(two_storeys({Material{}}, {{}, {}}), std::invalid_argument);
    CHECK_THROWS_AS(Scene({drawn_map(ground)}, {Material{}}, {Material{}}), std::invalid_argument);
    CHECK_THROWS_AS(Scene(std::vector<OccupancyGrid>{}, {Material{}}, {Material{}}),
                    std::invalid_argument);
    const double no_number = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Scene(on_floor(drawn_map(ground), no_number)), std::invalid_argument);
}

}  // namespace storeys_test
