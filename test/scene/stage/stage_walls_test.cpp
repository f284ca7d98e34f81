// SPDX-License-Identifier: MIT
#include "scene/stage/stage_walls.hpp"

#include "scene/images/image.hpp"
#include "scene/scene.hpp"
#include "test/scene/pictures.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace stage_walls_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

constexpr double pi_ = 3.14159265358979323846;
/// A few roundings of coordinates up to 20 m.
constexpr double rounding = 1e-12;  // [m]

bool near(Vec3 a, Vec3 b) { return distance(a, b) < rounding; }

/// A world in a folder of its own.
struct World {
    TemporaryFolder folder{};
    WorldOptions options = {};

    StageWalls walls(const std::string& text) const {
        return stage_walls(read_worldfile(folder.write("a.world", text), options), options);
    }
    /// The only grid of a world.
    OccupancyGrid grid(const std::string& text) const {
        StageWalls all = walls(text);
        REQUIRE(all.grids.size() == 1);
        return all.grids[0];
    }
    std::string mistake(const std::string& text) const {
        try {
            walls(text);
        } catch (const InputError& error) {
            return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) +
                   ": " + error.message();
        }
        return "";
    }
    /// A gray picture as it looks: '#' 0, '+' 127, '-' 128, '.' 255.
    void draw(const std::string& name, const std::vector<std::string>& rows) const {
        std::string pgm =
            "P2\n" + std::to_string(rows[0].size()) + " " + std::to_string(rows.size()) + "\n255\n";
        for (const auto& row : rows) {
            for (const char c : row) {
                pgm += c == '#' ? "0 " : c == '+' ? "127 " : c == '-' ? "128 " : "255 ";
            }
            pgm += "\n";
        }
        folder.write(name, pgm);
    }
};

/// The corners of a grid in the world: lower left and upper right on the body.
struct Corners {
    Vec3 first, opposite;
};
Corners corners(const OccupancyGrid& grid) {
    const MapFrame frame(grid);
    return {frame.to_world({0, 0}),
            frame.to_world({static_cast<double>(grid.columns), static_cast<double>(grid.rows)})};
}

std::string drawn(const OccupancyGrid& grid) {
    std::string text;
    for (int row = grid.rows - 1; row >= 0; --row) {
        for (int column = 0; column < grid.columns; ++column) {
            text += grid.at(column, row) == Cell::occupied ? '#' : '.';
        }
        if (row > 0) text += '/';
    }
    return text;
}

double occupied_area(const OccupancyGrid& grid) {
    const auto cells = std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied);
    return static_cast<double>(cells) * grid.cell_width * grid.cell_height;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The folder of the worlds that came with Stage, if the environment names it.
std::optional<std::string> stage_worlds() {
    const char* folder = std::getenv("ROVERNET_WORLDS");
    if (folder) return std::string(folder);
    MESSAGE("skipped: ROVERNET_WORLDS is not set");
    return std::nullopt;
}

}  // namespace

TEST_CASE("stage walls: the rectangle around the dark pixels is scaled to the model's size") {
    World world;
    world.draw("m.pgm", {"........",  //
                         "..#.+...",  //
                         "..-.#...",  //
                         "........"});
    const OccupancyGrid grid = world.grid("model ( bitmap \"m.pgm\" size [6 4] pose [10 20 0] )\n");
    CHECK(drawn(grid) == "#.#/..#");
    CHECK(grid.cell_width == 2);
    CHECK(grid.cell_height == 2);
    CHECK(grid.yaw == 0);
    CHECK(grid.origin == Vec3{7, 18, 0});
    CHECK(corners(grid).opposite == Vec3{13, 22, 0});
}

TEST_CASE(
    "stage walls: only the first channel of a pixel decides whether it is a wall; alpha has no "
    "effect") {
    World world;
    test::PngPicture picture{.width = 4, .rows = {}};
    picture.color_type = PNG_COLOR_TYPE_RGB_ALPHA;
    picture.rows = {{127, 255, 255, 0, 128, 0, 0, 255, 255, 0, 0, 255, 0, 255, 255, 255}};
    world.folder.write("m.png", test::png_bytes(picture));
    CHECK(drawn(world.grid("model ( bitmap \"m.png\" size [4 1] )\n")) == "#..#");
}

TEST_CASE("stage walls: the colours of a palette image decide which pixels are walls") {
    World world;
    test::PngPicture picture{.width = 3, .rows = {}};
    picture.color_type = PNG_COLOR_TYPE_PALETTE;
    picture.palette = {{200, 0, 0}, {10, 255, 255}};
    picture.rows = {{1, 0, 1}};
    world.folder.write("m.png", test::png_bytes(picture));
    CHECK(drawn(world.grid("model ( bitmap \"m.png\" size [3 1] )\n")) == "#.#");
}

TEST_CASE("stage walls: the keys `pose` and `origin` of a model move and rotate its walls") {
    World world;
    world.draw("m.pgm", {"##"});
    const OccupancyGrid turned =
        world.grid("model ( bitmap \"m.pgm\" size [4 2] pose [10 20 90] )\n");
    CHECK(near(corners(turned).first, {11, 18, 0}));
    CHECK(near(corners(turned).opposite, {9, 22, 0}));
    CHECK(std::abs(turned.yaw - pi_ / 2) < rounding);
    const OccupancyGrid shifted =
        world.grid("model ( bitmap \"m.pgm\" size [4 2] pose [10 20 0 90] origin [1 0 0 90] )\n");
    CHECK(near(corners(shifted).first, {12, 22, 0}));  // (10, 20) + 1 m up, turned by 180
    CHECK(near(corners(shifted).opposite, {8, 20, 0}));
}

TEST_CASE("stage walls: lengths are read in unit_length and angles in unit_angle") {
    World world;
    const OccupancyGrid box = world.grid(
        "unit_length \"mm\" unit_angle \"radians\"\nmodel ( size [4000 2000] pose [10000 0 "
        "1.5707963267948966] )\n");
    CHECK(near(corners(box).first, {11, -2, 0}));
    CHECK(near(corners(box).opposite, {9, 2, 0}));
}

TEST_CASE("stage walls: a model without a bitmap and without an outline is a solid box") {
    World world;
    const StageWalls walls = world.walls(
        "model ( size [2 1] pose [5 5 0] )\nmodel ( size [1 1 3] noblocks 1 )\nmodel ( )\n");
    REQUIRE(walls.grids.size() == 2);
    CHECK(drawn(walls.grids[0]) == "#");
    CHECK(corners(walls.grids[0]).first == Vec3{4, 4.5, 0});
    CHECK(corners(walls.grids[0]).opposite == Vec3{6, 5.5, 0});
    CHECK(walls.grids[1].cell_width == 0.4);
    CHECK(std::abs(Scene(walls.grids[0]).wall_length({0, 5, 0}, {10, 5, 0}) - 2) < rounding);
}

TEST_CASE(
    "stage walls: submodels of a wall are walls placed relative to this wall; robots are not "
    "walls") {
    World world;
    const StageWalls walls = world.walls(
        "define room model ( size [2 2] )\n"
        "room ( pose [10 0 90] room ( pose [3 0 0] room ( pose [0 1 45] ) ) laser ( ) )\n"
        "position ( size [1 1] model ( size [1 1] ) wifi ( ) )\n"
        "laser ( model ( ) )\nwindow ( size [500 500] )\n");
    REQUIRE(walls.grids.size() == 3);
    const auto middle = [&](std::size_t i) {
        const Corners c = corners(walls.grids[i]);
        return 0.5 * (c.first + c.opposite);
    };
    CHECK(near(middle(0), {10, 0, 0}));
    CHECK(near(middle(1), {10, 3, 0}));
    CHECK(near(middle(2), {9, 3, 0}));
    CHECK(std::abs(walls.grids[2].yaw - 135 * pi_ / 180) < rounding);
}

TEST_CASE(
    "stage walls: a model through which laser beams pass is not a wall, but its submodels may be "
    "walls") {
    World world;
    CHECK(world.walls("model ( laser_return 0 )\nmodel ( ranger_return -1 )\n").grids.empty());
    CHECK(world.walls("model ( ranger_return -0.5 )\nmodel ( laser_return -1 )\n").grids.empty());
    CHECK(world.walls("model ( ranger_return 0 )\n").grids.size() == 1);
    CHECK(world.walls("model ( laser_return 0 ranger_return 0 )\n").grids.empty());
    CHECK(world.walls("model ( laser_return 2 )\nmodel ( ranger_return 0.5 )\n").grids.size() == 2);
    CHECK(world.walls("model ( obstacle_return 0 )\n").grids.size() == 1);
    CHECK(world.walls("model ( bitmap \"\" )\n").grids.size() == 1);  // a box
    CHECK(world.walls("model ( laser_return 0 model ( ) )\n").grids.size() == 1);
}

TEST_CASE(
    "stage walls: the key `boundary` adds four walls, 1 cm thick, just inside the model's size") {
    World world;
    world.draw("m.pgm", {"#.", ".#"});
    const StageWalls walls =
        world.walls("model ( bitmap \"m.pgm\" size [4 2] pose [10 20 0] boundary 1 )\n");
    REQUIRE(walls.grids.size() == 5);
    double area = 0;
    for (std::size_t i = 1; i < 5; ++i) {
        const Corners c = corners(walls.grids[i]);
        area += occupied_area(walls.grids[i]);
        CHECK(c.first.x >= 8 - rounding);
        CHECK(c.first.y >= 19 - rounding);
        CHECK(c.opposite.x <= 12 + rounding);
        CHECK(c.opposite.y <= 21 + rounding);
        CHECK(std::abs(std::min(c.opposite.x - c.first.x, c.opposite.y - c.first.y) - 0.01) <
              rounding);
    }
    CHECK(std::abs(area - (4 * 2 - 3.98 * 1.98)) < rounding);  // the frame, nothing twice
    const StageWalls alone = world.walls("model ( size [4 2] noblocks 1 boundary 1 )\n");
    CHECK(alone.grids.size() == 4);
    CHECK(alone.notices.empty());
}

TEST_CASE("stage walls: a model with a boundary but no bitmap stays a solid box, with a notice") {
    World world;
    const StageWalls walls = world.walls("\nmodel ( size [4 2] boundary 1 )\n");
    CHECK(walls.grids.size() == 1);
    REQUIRE(walls.notices.size() == 1);
    CHECK(contains(walls.notices[0],
                   "a.world:2: a model with a boundary and without a bitmap is a "
                   "solid"));
}

TEST_CASE("stage walls: rectangular polygons of Stage 2 and blocks of Stage 4 become exact boxes") {
    World world;
    const StageWalls old_style = world.walls(
        "model ( size [4 4] pose [1 1 0] polygons 2\n"
        "polygon[0].points 4 polygon[0].point[0] [0 0] polygon[0].point[1] [2 0]\n"
        "polygon[0].point[2] [2 1] polygon[0].point[3] [0 1]\n"
        "polygon[1].points 5 polygon[1].point[0] [0 1] polygon[1].point[1] [0 4]\n"
        "polygon[1].point[2] [1 4] polygon[1].point[3] [1 1] polygon[1].point[4] [0 1] )\n");
    const StageWalls new_style = world.walls(
        "model ( size [4 4 1] pose [1 1 0 0]\n"
        "block ( points 4 point[0] [0 0] point[1] [2 0] point[2] [2 1] point[3] [0 1] z [0 1] )\n"
        "block ( points 4 point[0] [0 1] point[1] [0 4] point[2] [1 4] point[3] [1 1] ) )\n");
    for (const auto* walls : {&old_style, &new_style}) {
        REQUIRE(walls->grids.size() == 2);
        CHECK(walls->notices.empty());
        CHECK(near(corners(walls->grids[0]).first, {-1, -1, 0}));
        CHECK(near(corners(walls->grids[0]).opposite, {3, 0, 0}));
        CHECK(near(corners(walls->grids[1]).first, {-1, 0, 0}));
        CHECK(near(corners(walls->grids[1]).opposite, {1, 3, 0}));
    }
}

TEST_CASE(
    "stage walls: outlines that are not rectangles become cells of at most 2 cm, with one notice") {
    World world;
    const StageWalls walls = world.walls(
        "model ( size [2 1.01] pose [3 0 0]\n"
        "block ( points 3\npoint[0] [0 0] point[1] [8 0] point[2] [0 8] ) )\n"
        "model ( size [1 1] block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] ) )\n");
    REQUIRE(walls.grids.size() == 2);
    REQUIRE(walls.notices.size() == 1);
    CHECK(contains(walls.notices[0],
                   "a.world:2: each wall whose outline is not a box along the axes of its model is "
                   "approximated by cells of at most 0.02 m"));
    const OccupancyGrid& triangle = walls.grids[0];
    CHECK(triangle.columns == 100);
    CHECK(triangle.rows == 51);
    CHECK(triangle.cell_width <= 0.02 + rounding);
    CHECK(triangle.cell_height <= 0.02);
    CHECK(near(corners(triangle).first, {2, -0.505, 0}));
    CHECK(near(corners(triangle).opposite, {4, 0.505, 0}));
    // Half the box, but for the cells that the slanted side cuts: at most one in each row, by half.
    CHECK(std::abs(occupied_area(triangle) - 1.01) < 51 * 0.02 * 0.02);
    CHECK(triangle.at(0, 0) == Cell::occupied);
    CHECK(triangle.at(99, 50) == Cell::free);
}

TEST_CASE(
    "stage walls: the inside of an outline that crosses itself is found by the even-odd rule") {
    World world;
    const OccupancyGrid bow = world.grid(
        "model ( size [1 1] block ( points 4 point[0] [0 0] point[1] [1 1] point[2] [1 0] "
        "point[3] [0 1] ) )\n");
    CHECK(std::abs(occupied_area(bow) - 0.5) < 50 * 0.02 * 0.02);
    CHECK(bow.at(25, 0) == Cell::free);
    CHECK(bow.at(25, 49) == Cell::free);
    CHECK(bow.at(0, 25) == Cell::occupied);
    CHECK(bow.at(49, 25) == Cell::occupied);
}

TEST_CASE("stage walls: each colour of the walls becomes one material") {
    World world;
    const StageWalls walls = world.walls(
        "define brick model ( color \"brown\" )\n"
        "brick ( )\nmodel ( color \"glass blue\" )\nbrick ( )\nmodel ( )\n"
        "model ( color_rgba [0 0.5 1 1] )\nposition ( color \"green\" )\n"
        "model ( color \"pink\" laser_return 0 )\n");
    std::vector<std::string> names;
    for (const auto& material : walls.materials) {
        names.push_back(material.name);
        CHECK(material.follows_model());
    }
    CHECK(names == std::vector<std::string>{"brown", "glass blue", "red", "rgba 0 0.5 1 1"});
    std::vector<int> used;
    for (const auto& grid : walls.grids) used.push_back(grid.material);
    CHECK(used == std::vector<int>{0, 1, 0, 2, 3});
    std::string many;
    for (int i = 0; i < 257; ++i) many += "model ( color \"c" + std::to_string(i) + "\" )\n";
    CHECK(world.mistake(many).starts_with(
        "257:1: color \"c256\" is one colour too many; expected at most "
        "256"));
}

TEST_CASE(
    "stage walls: the error for a missing bitmap lists the paths that were tried; with --lenient "
    "it is only a notice") {
    World world;
    const std::string text = "model (\n bitmap \"bits/m.pgm\" size [1 1] )\n";
    const std::string places =
        world.folder.path("bits/m.pgm") + " and " + world.folder.path("m.pgm");
    CHECK(world.mistake(text) == "2:2: bitmap: no file \"bits/m.pgm\"; tried the paths " + places +
                                     "; give the file's folder with --world-path, or another "
                                     "file with --bitmap m.pgm=NEW");
    world.options.lenient = true;
    const StageWalls walls = world.walls(text);
    CHECK(walls.grids.empty());
    REQUIRE(walls.notices.size() == 1);
    CHECK(walls.notices[0] ==
          world.folder.path("a.world") +
              ":2: bitmap \"bits/m.pgm\" is missing, so its walls are left out; tried the paths " +
              places);
}

TEST_CASE(
    "stage walls: a bitmap, given by its whole path or its file name, can be replaced by another "
    "image") {
    World world;
    world.draw("new.pgm", {"#.#"});
    for (const std::string old : {"bits/old.pgm", "old.pgm"}) {
        world.options.bitmaps = {{old, "new.pgm"}};
        CHECK(drawn(world.grid("model ( bitmap \"bits/old.pgm\" size [1 1] )\n")) == "#.#");
    }
    world.options.bitmaps = {{"ld.pgm", "new.pgm"}};
    CHECK(world.mistake("model ( bitmap \"old.pgm\" )\n") != "");
    world.options.bitmaps = {{"odl.pgm", "new.pgm"}};
    const auto notices = world.walls("model ( bitmap \"new.pgm\" size [1 1] )\n").notices;
    REQUIRE(notices.size() == 1);
    CHECK(contains(notices[0], "the world names no bitmap \"odl.pgm\", so the replacement"));
}

TEST_CASE("stage walls: several models may use one bitmap, each scaled to its own size") {
    World world;
    world.draw("m.pgm", {".#.#", "...."});
    const StageWalls walls = world.walls(
        "define tree model ( bitmap \"m.pgm\" )\n"
        "tree ( size [3 1] )\ntree ( size [6 2] pose [10 0 0] )\n");
    REQUIRE(walls.grids.size() == 2);
    CHECK(drawn(walls.grids[0]) == "#.#");
    CHECK(drawn(walls.grids[1]) == "#.#");
    CHECK(walls.grids[0].cell_width == 1);
    CHECK(walls.grids[1].cell_width == 2);
    CHECK(walls.grids[1].origin == Vec3{7, -1, 0});
}

TEST_CASE("stage walls: a bitmap without walls causes a notice, a damaged bitmap an error") {
    World world;
    world.draw("white.pgm", {".-"});
    const StageWalls walls = world.walls("model ( bitmap \"white.pgm\" )\n");
    CHECK(walls.grids.empty());
    REQUIRE(walls.notices.size() == 1);
    CHECK(contains(walls.notices[0], "a.world:1: bitmap"));
    CHECK(contains(walls.notices[0], "has no pixel with a grey level of at most 127"));
    world.folder.write("bad.pgm", "P2\n3 3\n255\n1 2");
    CHECK_THROWS_AS(world.walls("model ( bitmap \"bad.pgm\" )\n"), InputError);
}

TEST_CASE("stage walls: a value of a wrong type is refused, with line and column") {
    const World world;
    CHECK(world.mistake("model ( laser_return \"yes\" )\n") ==
          "1:9: laser_return: found a text; expected one number; write laser_return 1");
    CHECK(world.mistake("model ( laser_return \"0.5\" )\n") ==
          "1:9: laser_return: found a text; expected one number; write laser_return 0.5");
    CHECK(
        world.mistake("model ( bitmap 5 )\n").starts_with("1:9: bitmap: found a number; expected"));
    CHECK(world.mistake("model ( block ( ) )\n") ==
          "1:9: the key \"points\" is missing; expected the number of points; write points 4");
    CHECK(world.mistake("model ( block ( points 3 point[0] [0 0] point[1] [1 1] ) )\n")
              .starts_with("1:17: points: found no point[2]; expected 3 points from point[0] on;"));
    CHECK(world.mistake("model ( polygons 1 polygon[0].points 1 polygon[0].point[0] [0 0 0] )\n") ==
          "1:40: polygon[0].point[0]: expected two numbers [x y], at most 1e9; write "
          "polygon[0].point[0] [0.1 0.2]");
    CHECK(world.mistake("model ( polygons -1 )\n")
              .starts_with("1:9: polygons: found -1; expected a"));
    CHECK(world.mistake("model ( block ( points 1.5 ) )\n").starts_with("1:17: points: found 1.5"));
    CHECK(world.mistake("model ( color_rgba [\"a\"] )\n")
              .starts_with("1:9: color_rgba: found a text"));
    CHECK(world.mistake("model ( size [0 5] )\n") == "");  // nothing there
    CHECK(world.walls("model ( size [0 5] )\n").grids.empty());
}

TEST_CASE("stage walls: walls of more than 256 million cells are refused") {
    const World world;
    CHECK(contains(world.mistake("model ( size [5000 5000] block ( points 3 point[0] [0 0] "
                                 "point[1] [1 0] point[2] [0 1] ) )\n"),
                   "the walls have more than 256 million pixels and cells"));
}

TEST_CASE(
    "stage walls: the images that came with Stage have the published number of occupied pixels") {
    const auto folder = stage_worlds();
    if (!folder) return;
    struct Row {
        std::string name;
        std::ptrdiff_t occupied;
        int columns, rows;
    };
    const World world;
    for (const Row& row : {Row{"cave.png", 5270, 500, 500}, Row{"cave_filled.png", 59067, 500, 500},
                           Row{"hospital_section.png", 17158, 1082, 443},
                           Row{"simple_rooms.png", 36816, 400, 300}}) {
        CAPTURE(row.name);
        const OccupancyGrid grid =
            world.grid("model ( bitmap \"" + *folder + "/stage-wifi/bitmaps/" + row.name +
                       "\" size [16 16] )\n");
        CHECK(std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied) == row.occupied);
        CHECK(grid.columns == row.columns);
        CHECK(grid.rows == row.rows);
    }
}

TEST_CASE("stage walls: wall lengths in the worlds that came with Stage are exact") {
    const auto folder = stage_worlds();
    if (!folder) return;
    constexpr double half_a_digit = 0.5000001e-6;  // [m] the published lengths have six decimals
    struct Row {
        std::string bitmap;
        std::string size;
        Vec3 a, b;
        double length;
    };
    const std::string cave = "[16 16]";
    const std::string filled = "cave_filled.png", hospital = "hospital_section.png";
    const World world;
    for (const Row& row : {
             Row{"cave.png", cave, {-6.5, -6.5, 0}, {-3.5, -2.5, 0}, 0.186667},
             Row{"cave.png", cave, {-6.5, -6.5, 0}, {6.5, 6.5, 0}, 0.181019},
             Row{"cave.png", cave, {-3.5, -2.5, 0}, {6.5, 6.5, 0}, 0.185959},
             Row{"cave.png", cave, {5, 5, 0}, {-5, -5, 0}, 0.181019},
             Row{"cave.png", cave, {-6.5, -6.5, 0}, {-3.5, -4.5, 0}, 0},
             Row{filled, cave, {-6.5, -6.5, 0}, {-3.5, -2.5, 0}, 0.588333},
             Row{filled, cave, {-6.5, -6.5, 0}, {6.5, 6.5, 0}, 2.896309},
             Row{filled, cave, {-3.5, -2.5, 0}, {6.5, 6.5, 0}, 2.912560},
             Row{filled, cave, {5, 5, 0}, {-5, -5, 0}, 2.896309},
             Row{hospital, "[40 18]", {-19, 5, 0}, {-3.5, -4.5, 0}, 0.276626},
         }) {
        CAPTURE(row.bitmap);
        CAPTURE(row.length);
        const Scene scene(world.grid("model ( bitmap \"" + *folder + "/stage-wifi/bitmaps/" +
                                     row.bitmap + "\" size " + row.size + " )\n"));
        CHECK(std::abs(scene.wall_length(row.a, row.b) - row.length) < half_a_digit);
        CHECK(scene.wall_length(row.b, row.a) == scene.wall_length(row.a, row.b));
    }
}

TEST_CASE("stage walls: a bitmap may be a JPEG, a BMP or a GIF") {
    const World world;
    world.folder.write("half.jpg", test::gray_jpeg());
    world.folder.write("dots.gif", test::opaque_gif());
    world.folder.write("dots.bmp",
                       test::bmp_header(2, 1, 24) + std::string(3, '\0') + std::string(5, '\377'));
    const auto walls = [&](const char* name) {
        const OccupancyGrid grid =
            world.grid("model ( bitmap \"" + std::string(name) + "\" size [4 2 1] )");
        return std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied);
    };
    CHECK(walls("half.jpg") == 64);
    CHECK(walls("dots.gif") == 2);
    CHECK(walls("dots.bmp") == 1);
}

}  // namespace stage_walls_test
