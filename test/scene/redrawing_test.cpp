// SPDX-License-Identifier: MIT
#include "scene/redrawing.hpp"

#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace redrawing_test {
using namespace rovernet;
using test::Draw;
using test::drawn_map;

namespace {

std::vector<std::string> drawing(const OccupancyGrid& map) {
    std::vector<std::string> rows;
    for (int row = map.rows - 1; row >= 0; --row) {
        std::string line;
        for (int column = 0; column < map.columns; ++column) {
            const Cell cell = map.at(column, row);
            line += cell == Cell::occupied ? '#' : cell == Cell::unknown ? '?' : '.';
        }
        rows.push_back(line);
    }
    return rows;
}

/// A map whose walls have two materials, 1 in the left half and 2 in the right.
OccupancyGrid two_materials(const std::vector<std::string>& rows) {
    OccupancyGrid map = drawn_map(rows);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        const int column = static_cast<int>(i) % map.columns;
        map.cell_materials.push_back(column < map.columns / 2 ? 1 : 2);
    }
    return map;
}

const std::vector<std::string> hollow = {".........",  //
                                         ".#######.",  //
                                         ".#.....#.",  //
                                         ".#######.",  //
                                         "........."};

Scene with_metal(OccupancyGrid map) {
    map.material = 1;
    return Scene(std::move(map), {Material{}, Material{.name = "metal", .per_crossing = Db{40}}});
}

}  // namespace

TEST_CASE("redrawing: a map whose cells are split has the same walls, to the last bit") {
    Draw draw(7);
    OccupancyGrid map = test::random_map(draw, 23, 17, 30);
    map.cell_width = map.cell_height = 0.25;
    map.origin = {-1.5, 2.25};
    const OccupancyGrid split = split_cells(map);
    CHECK(split.columns == 46);
    CHECK(split.cell_width == 0.125);
    const Scene as_given(map), finer(split);
    for (int i = 0; i < 500; ++i) {
        const Vec3 a{draw.uniform(-2, 5), draw.uniform(2, 7)};
        const Vec3 b{draw.uniform(-2, 5), draw.uniform(2, 7)};
        CHECK(finer.wall_length(a, b) == as_given.wall_length(a, b));
    }
}

TEST_CASE(
    "redrawing: four joined cells become a wall if at least one is a wall, with the first wall's "
    "material") {
    const OccupancyGrid joined = join_cells(two_materials({"....?",  //
                                                           ".....",  //
                                                           "..#..",  //
                                                           "#..?."}));
    CHECK(drawing(joined) == std::vector<std::string>{"..?", "##."});
    CHECK(joined.cell_width == 2);
    CHECK(joined.cell_materials[0] == 1);
    CHECK(joined.cell_materials[1] == 2);
}

TEST_CASE("redrawing: a map of a single cell is not joined into larger cells") {
    CHECK(drawing(join_cells(drawn_map({"#"}))) == std::vector<std::string>{"#"});
    CHECK(join_cells(drawn_map({"#"})).cell_width == 1);
}

TEST_CASE("redrawing: splitting cells and joining them again gives the original map") {
    Draw draw(3);
    const OccupancyGrid map = test::random_map(draw, 20, 13, 40);
    CHECK(drawing(join_cells(split_cells(map))) == drawing(map));
}

TEST_CASE(
    "redrawing: a thick wall is replaced by its outline without gaps, and a thin wall is "
    "unchanged") {
    const OccupancyGrid outlined = outline_walls(drawn_map({"########.#",  //
                                                            "########.#",  //
                                                            "########.#",  //
                                                            "...####..#",  //
                                                            ".........#"}));
    CHECK(drawing(outlined) == std::vector<std::string>{"########.#",  //
                                                        "#......#.#",  //
                                                        "####..##.#",  //
                                                        "...####..#",  //
                                                        ".........#"});
}

TEST_CASE(
    "redrawing: a hollow wall, up to the given width, is filled with the material of the nearest "
    "side") {
    const OccupancyGrid map = two_materials(hollow);
    const OccupancyGrid filled = fill_walls(map, Meters{1});
    CHECK(drawing(filled)[2] == ".#######.");
    CHECK(drawing(filled)[0] == ".........");
    CHECK(filled.cell_materials[2 * 9 + 2] == 1);
    CHECK(filled.cell_materials[2 * 9 + 6] == 2);
    CHECK(drawing(fill_walls(map, Meters{0.5})) == drawing(map));
}

TEST_CASE("redrawing: an area that is open, or wider than the given width, is not filled") {
    const OccupancyGrid open = drawn_map({"####", "#...", "####"});
    CHECK(drawing(fill_walls(open, Meters{5})) == drawing(open));
    const OccupancyGrid room = drawn_map({"#####", "#...#", "#...#", "#...#", "#####"});
    CHECK(drawing(fill_walls(room, Meters{2.9})) == drawing(room));
    CHECK(drawing(fill_walls(room, Meters{3}))[2] == "#####");
}

TEST_CASE("redrawing: outlining a wall and filling the outline gives the original wall") {
    const OccupancyGrid wall = drawn_map({".......", ".#####.", ".#####.", ".#####.", "......."});
    CHECK(drawing(outline_walls(wall)) != drawing(wall));
    CHECK(drawing(fill_walls(outline_walls(wall), Meters{1})) == drawing(wall));
}

TEST_CASE(
    "scene: a scene built again from its own maps has the same walls, for one map or several") {
    OccupancyGrid turned = drawn_map({"#.#", ".##"}, 0.5);
    turned.yaw = 0.3;
    turned.origin = {4, 1};
    turned.material = 1;
    const OccupancyGrid hall = drawn_map({"####", "#..#", "####"});
    Draw draw(5);
    for (const auto& maps : {std::vector{hall}, std::vector{hall, turned}}) {
        const Scene scene(maps, {Material{}, Material{.per_crossing = Db{7}}});
        const Scene again(scene.maps(), scene.materials());
        for (int i = 0; i < 100; ++i) {
            const Vec3 a{draw.uniform(-1, 7), draw.uniform(-1, 4)};
            const Vec3 b{draw.uniform(-1, 7), draw.uniform(-1, 4)};
            CHECK(again.crossings(a, b) == scene.crossings(a, b));
        }
    }
}

TEST_CASE(
    "scene: if radio uses the walls of another scene, robots still avoid the obstacles of their "
    "own scene") {
    const Scene own(drawn_map({"...", ".#.", "..."}));
    const Scene other = with_metal(drawn_map({"#..", "#..", "#.."}));
    const Scene both = own.with_walls_of(other);
    CHECK(both.wall_length({0, 0.5}, {3, 0.5}) == 1);
    CHECK(both.crossings({0, 1.5}, {3, 1.5}).front().entry == 0);
    CHECK_FALSE(both.passable({0, 1.5}, {3, 1.5}, Meters{0}));
    CHECK(both.passable({0.5, 0.5}, {0.5, 2.5}, Meters{0.2}));
    CHECK(both.materials().size() == 2);
    CHECK(both.faces() == other.faces());
    CHECK(own.plain_walls());
    CHECK_FALSE(both.plain_walls());
}

}  // namespace redrawing_test
