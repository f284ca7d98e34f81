// SPDX-License-Identifier: MIT
#include "scene/occupancy.hpp"

#include "sim/error.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace occupancy_test {
using namespace rovernet;
using test::png_bytes;
using test::TemporaryFolder;

namespace {

constexpr Cell free_cell = Cell::free, occupied = Cell::occupied, unknown = Cell::unknown;
using Cells = std::vector<Cell>;

/// A map of one row of pixels with these grays, and these lines added to the YAML file.
Cells cells_of(const std::vector<png_byte>& grays, const std::string& lines = "") {
    const TemporaryFolder folder;
    folder.write("map.png",
                 png_bytes({.width = static_cast<png_uint_32>(grays.size()), .rows = {grays}}));
    return read_ros_map(folder.write("map.yaml",
                                     "image: map.png\nresolution: 0.05\n"
                                     "origin: [0, 0, 0]\n" +
                                         lines))
        .cells;
}

Cells rgba_cells(const std::vector<png_byte>& rgba, const std::string& lines) {
    const TemporaryFolder folder;
    folder.write("map.png", png_bytes({.width = static_cast<png_uint_32>(rgba.size() / 4),
                                       .color_type = PNG_COLOR_TYPE_RGBA,
                                       .rows = {rgba}}));
    return read_ros_map(folder.write("map.yaml",
                                     "image: map.png\nresolution: 1\n"
                                     "origin: [0, 0, 0]\n" +
                                         lines))
        .cells;
}

/// Notices of a map of one black pixel whose YAML file ends in these lines, without its folder.
std::vector<std::string> notices_of(const std::string& lines) {
    const TemporaryFolder folder;
    folder.write("map.pgm", "P2 1 1 255 0");
    std::vector<std::string> notices;
    read_ros_map(
        folder.write("map.yaml", "image: map.pgm\nresolution: 0.05\norigin: [1, 2, 0]\n" + lines),
        notices);
    for (std::string& notice : notices) {
        CHECK(notice.starts_with(folder.path("")));
        notice.erase(0, folder.path("").size());
    }
    return notices;
}

/// "line:column message" of the error in this YAML file, "" if there is none.
std::string error_of(const std::string& yaml) {
    const TemporaryFolder folder;
    folder.write("map.pgm", "P2 1 1 255 0");
    const std::string path = folder.write("map.yaml", yaml);
    try {
        read_ros_map(path);
    } catch (const InputError& error) {
        CHECK(error.where().source.starts_with(folder.path("")));
        return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) +
               " " + error.message();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::string good = "image: map.pgm\nresolution: 0.05\norigin: [1, 2, 0]\n";

}  // namespace

TEST_CASE(
    "ROS map: size, origin and yaw are read, and the image's first row is the top of the map") {
    const TemporaryFolder folder;
    folder.write("map.pgm", "P2 2 3 255  254 254  0 254  205 0");
    const OccupancyGrid grid = read_ros_map(folder.write("map.yaml",
                                                         "image: map.pgm\n"
                                                         "resolution: 0.05\n"
                                                         "origin: [-10.5, 2.25, 0.5]\n"
                                                         "negate: 0\n"
                                                         "occupied_thresh: 0.65\n"
                                                         "free_thresh: 0.196\n"));
    CHECK(grid.columns == 2);
    CHECK(grid.rows == 3);
    CHECK(grid.cell_width == 0.05);
    CHECK(grid.cell_height == 0.05);
    CHECK(grid.origin == Vec3{-10.5, 2.25, 0});
    CHECK(grid.yaw == 0.5);
    // 205: occ = 0.19608, just above 0.196
    CHECK(grid.cells == Cells{unknown, occupied, occupied, free_cell, free_cell, free_cell});
    CHECK(grid.at(1, 0) == occupied);
    CHECK(grid.at(1, 1) == free_cell);
}

TEST_CASE("ROS map: the image is searched beside the YAML file, or at an absolute path") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("maps"));
    folder.write("maps/a.pgm", "P2 1 1 255 0");
    const std::string rest = "\nresolution: 1\norigin: [0, 0, 0]\n";
    CHECK(read_ros_map(folder.write("maps/a.yaml", "image: a.pgm" + rest)).cells[0] == occupied);
    CHECK(read_ros_map(folder.write("b.yaml", "image: maps/a.pgm" + rest)).columns == 1);
    CHECK(read_ros_map(folder.write("c.yaml", "image: " + folder.path("maps/a.pgm") + rest)).rows ==
          1);
    CHECK_THROWS_AS(read_ros_map(folder.write("d.yaml", "image: a.pgm" + rest)), InputError);
}

TEST_CASE(
    "ROS map: a pixel exactly at a threshold is unknown; the default thresholds are 0.65 and "
    "0.25") {
    // occ = 1 - gray / 255: 89 -> 0.65098, 90 -> 0.64706, 191 -> 0.25098, 192 -> 0.24706
    CHECK(cells_of({0, 89, 90, 191, 192, 255}) ==
          Cells{occupied, occupied, unknown, unknown, free_cell, free_cell});
    // 51 / 255 is 0.2 and 204 / 255 is 0.8, exactly as the decimals are read
    CHECK(cells_of({51, 204}, "negate: 1\nfree_thresh: 0.2\noccupied_thresh: 0.8\n") ==
          Cells{unknown, unknown});
    CHECK(cells_of({50, 205}, "negate: 1\nfree_thresh: 0.2\noccupied_thresh: 0.8\n") ==
          Cells{free_cell, occupied});
}

TEST_CASE("ROS map: the key `negate` exchanges black and white") {
    CHECK(cells_of({0, 255}) == Cells{occupied, free_cell});
    for (const char* yes : {"1", "true", "True", "yes", "2"})
        CHECK(cells_of({0, 255}, std::string("negate: ") + yes + "\n") ==
              Cells{free_cell, occupied});
    for (const char* no : {"0", "false"})
        CHECK(cells_of({0, 255}, std::string("negate: ") + no + "\n") ==
              Cells{occupied, free_cell});
}

TEST_CASE("ROS map: in trinary mode, red, green, blue and an alpha channel are averaged") {
    const TemporaryFolder folder;
    // (255 + 0 + 0) / 3 = 85: occ 0.667; (255 + 255 + 60) / 3 = 190: occ 0.255
    folder.write("map.png", png_bytes({.width = 2,
                                       .color_type = PNG_COLOR_TYPE_RGB,
                                       .rows = {{255, 0, 0, 255, 255, 60}}}));
    CHECK(read_ros_map(folder.write("map.yaml", "image: map.png\nresolution: 1\norigin: [0, 0, 0]"))
              .cells == Cells{occupied, unknown});
    // opaque black: (0 + 255) / 4, occ 0.75; transparent black: occ 1; transparent white: 0.25
    CHECK(rgba_cells({0, 0, 0, 255, 0, 0, 0, 0, 255, 255, 255, 0, 255, 255, 255, 255}, "") ==
          Cells{occupied, occupied, unknown, free_cell});
    CHECK(rgba_cells({0, 0, 0, 255}, "occupied_thresh: 0.8") == Cells{unknown});
}

TEST_CASE("ROS map: in scale mode a pixel that is not opaque is unknown") {
    CHECK(rgba_cells({0, 0, 0, 255, 0, 0, 0, 254, 255, 255, 255, 255, 255, 255, 255, 0},
                     "mode: scale\n") == Cells{occupied, unknown, free_cell, unknown});
    CHECK(rgba_cells({0, 0, 0, 255}, "mode: scale\noccupied_thresh: 0.8") == Cells{occupied});
    CHECK(cells_of({0, 128, 255}, "mode: scale") == Cells{occupied, unknown, free_cell});
}

TEST_CASE(
    "ROS map: in raw mode a pixel is the occupancy in percent, and values above 100 are unknown") {
    const Cells expected{free_cell, free_cell, unknown, unknown,
                         occupied,  occupied,  unknown, unknown};
    CHECK(cells_of({0, 24, 25, 65, 66, 100, 101, 255}, "mode: raw") == expected);
    CHECK(cells_of({0, 24, 25, 65, 66, 100, 101, 255}, "mode: raw\nnegate: 1") == expected);
    CHECK(cells_of({0, 255}, "mode: trinary") == Cells{occupied, free_cell});
}

TEST_CASE("ROS map: errors name line and column, and what to write instead") {
    CHECK(error_of(good) == "");
    CHECK(
        contains(error_of("resolution: 0.05\norigin: [0, 0, 0]"), "the key \"image\" is missing"));
    CHECK(contains(error_of("image: map.pgm\norigin: [0, 0, 0]"),
                   "the key \"resolution\" is missing"));
    CHECK(contains(error_of("image: map.pgm\nresolution: 1"), "the key \"origin\" is missing"));
    const std::string typo = error_of(good + "ocupied_thresh: 0.65\n");
    CHECK(contains(typo, "4:1 unknown key \"ocupied_thresh\""));
    CHECK(contains(typo, "did you mean \"occupied_thresh\"?"));
    CHECK(contains(error_of(good + "mode: trinry\n"), "4:7 \"mode\" is \"trinry\""));
    CHECK(contains(error_of(good + "mode: trinry\n"), "did you mean \"trinary\"?"));
    CHECK(contains(error_of(good + "mode: [raw]\n"), "4:7 \"mode\" is a list"));
    CHECK(contains(error_of(good + "negate: maybe\n"), "4:9 \"negate\" is \"maybe\""));
    CHECK(contains(error_of(good + "negate: 0\nnegate: 1\n"), "5:1 key \"negate\" is given twice"));
    CHECK(contains(error_of(good + "free_thresh: low\n"), "4:14 \"free_thresh\" is \"low\""));
    CHECK(contains(error_of(good + "free_thresh: .nan\n"), "4:14 \"free_thresh\" is \".nan\""));
    CHECK(contains(error_of(good + "free_thresh: -0.1\n"), "from 0 to 1"));
    CHECK(contains(error_of(good + "occupied_thresh: 65\n"), "from 0 to 1"));
    CHECK(contains(error_of(good + "free_thresh: 0.5\noccupied_thresh: 0.5\n"), "5:18 \"occupied"));
}

TEST_CASE("ROS map: a key of another program gives a notice, a misspelt key is an error") {
    using Notices = std::vector<std::string>;
    CHECK(notices_of("") == Notices{});
    CHECK(notices_of("map_type: occupancy\n") ==
          Notices{"map.yaml:4:1: key \"map_type\" is not a key of a map and is ignored"});
    CHECK(notices_of("name: hall\nframe_id: map\nunknown_thresh: {a: [1]}\n").size() == 3);
    CHECK(notices_of("occupied_thresh: 0.65\noccupied_threshold: 0.9\n").size() == 1);
    CHECK(notices_of("{1: 2, [a]: b}: 3\n").size() == 1);
    CHECK(contains(error_of(good + "free_tresh: 0.1\n"), "did you mean \"free_thresh\"?"));
    CHECK(contains(error_of(good + "map_type: a\nmap_type: b\n"), "is given twice"));
    CHECK(contains(error_of("image: map.pgm\nresolutoin: 1\norigin: [0, 0, 0]"),
                   "2:1 unknown key \"resolutoin\""));
}

TEST_CASE(
    "ROS map: if one threshold is missing and its default contradicts the other, both get the "
    "other's value") {
    CHECK(notices_of("occupied_thresh: 0.05\n") ==
          std::vector<std::string>{
              "map.yaml:4:18: the key \"free_thresh\" is missing, and its default value 0.25 "
              "contradicts occupied_thresh = 0.05, so both keys get the value 0.05"});
    CHECK(notices_of("free_thresh: 0.7\n").size() == 1);
    CHECK(notices_of("occupied_thresh: 0.3\n").empty());
    CHECK(notices_of("free_thresh: 0.6\n").empty());
    // occ = 1 - gray / 255: 243 -> 0.04706, 242 -> 0.05098, 77 -> 0.69804, 76 -> 0.70196
    CHECK(cells_of({243, 242, 0}, "occupied_thresh: 0.05") == Cells{free_cell, occupied, occupied});
    CHECK(cells_of({77, 76, 255}, "free_thresh: 0.7") == Cells{free_cell, occupied, free_cell});
}

TEST_CASE(
    "ROS map: if the image's path is of another machine, the error suggests the image beside the "
    "file") {
    const std::string rest = "\nresolution: 1\norigin: [0, 0, 0]\n";
    for (const char* path : {"/home/someone/maps/map.pgm", "~/maps/map.pgm", "maps/map.pgm",
                             "'C:\\maps\\map.pgm'", "../map.pgm"}) {
        const std::string error = error_of(std::string("image: ") + path + rest);
        CHECK_MESSAGE(contains(error, "1:8 \"image\" is "), error);
        CHECK_MESSAGE(contains(error,
                               "there is no such file, but there is \"map.pgm\" in the same "
                               "folder; write image: map.pgm"),
                      error);
    }
    CHECK_FALSE(contains(error_of("image: ~/gone.pgm" + rest), "beside"));
    CHECK(contains(error_of("image: maps/" + rest), "no such file"));
}

TEST_CASE("ROS map: an invalid resolution or origin is an error with line and column") {
    const auto resolution = [](const std::string& value) {
        return error_of("image: map.pgm\nresolution: " + value + "\norigin: [0, 0, 0]\n");
    };
    for (const char* bad : {"0", "-0.05", ".nan", ".inf", "5 cm", "[1]", "''", "~"})
        CHECK_MESSAGE(contains(resolution(bad), "2:13 \"resolution"), bad);
    const auto origin = [](const std::string& value) {
        return error_of("image: map.pgm\nresolution: 1\norigin: " + value + "\n");
    };
    CHECK(contains(origin("[0, 0]"), "3:9 \"origin\" is a list of 2; expected exactly three"));
    CHECK(contains(origin("[0, 0, 0, 0]"), "3:9 \"origin\" is a list of 4"));
    CHECK(contains(origin("0"), "3:9 \"origin\" is \"0\""));
    CHECK(contains(origin("[0, north, 0]"), "3:13 \"origin\" is \"north\""));
    CHECK(contains(origin("[0, 0, .nan]"), "3:16 \"origin\" is \".nan\""));
    CHECK(contains(origin("{x: 0}"), "\"origin\" is a map"));
}

TEST_CASE(
    "ROS map: a missing file, and a file that is not YAML or describes no map, are refused with "
    "the reason") {
    CHECK(contains(error_of("image: [map.pgm\nresolution: 1\n"), "not valid YAML"));
    CHECK_FALSE(error_of("image: [map.pgm\nresolution: 1\n").starts_with("0:0"));
    CHECK(contains(error_of(""), "no \"key: value\" lines"));
    CHECK(contains(error_of("- image\n"), "no \"key: value\" lines"));
    CHECK(contains(error_of("just words"), "no \"key: value\" lines"));
    CHECK(contains(error_of("{1: 2, [a]: b}"), "the key \"image\" is missing"));
    CHECK(contains(error_of("[a]: b"), "the key \"image\" is missing"));
    CHECK(error_of(std::string(5000, '[')) != "");
    CHECK(error_of("\xff\xfe\x00") != "");
    CHECK(contains(error_of(std::string(2'000'000, ' ')), "more than a megabyte"));
    CHECK(contains(error_of("image: ''\nresolution: 1\norigin: [0, 0, 0]"),
                   "1:8 \"image\" is empty"));
    CHECK(contains(error_of("image: gone.pgm\nresolution: 1\norigin: [0, 0, 0]"), "no such file"));
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_ros_map(folder.path("absent.yaml")), InputError);
    CHECK_THROWS_AS(read_ros_map(folder.path(".")), InputError);
}

TEST_CASE("image map: an image is scaled to its size, and dark pixels are walls") {
    const TemporaryFolder folder;
    // mean below 127.5 of 255 is wall: 127 is, 128 is not
    const std::string path = folder.write("map.pgm", "P2 4 2 255  0 127 128 255  0 255 255 255");
    const OccupancyGrid grid = image_map(path, 20_m, 5_m);
    CHECK(grid.cell_width == 5);
    CHECK(grid.cell_height == 2.5);
    CHECK(grid.origin == Vec3{0, 0, 0});
    CHECK(grid.cells == Cells{occupied, free_cell, free_cell, free_cell, occupied, occupied,
                              free_cell, free_cell});
}

TEST_CASE("image map: a fully transparent pixel is free; any other pixel counts by its colour") {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("map.png", png_bytes({.width = 3,
                                           .color_type = PNG_COLOR_TYPE_RGBA,
                                           .rows = {{0, 0, 0, 0, 0, 0, 0, 1, 255, 0, 0, 255}}}));
    CHECK(image_map(path, 3_m, 1_m).cells == Cells{free_cell, occupied, occupied});
}

TEST_CASE("image map: a size that is not positive and finite throws std::invalid_argument") {
    const TemporaryFolder folder;
    const std::string path = folder.write("map.pgm", "P2 1 1 255 0");
    CHECK_THROWS_AS(image_map(path, 0_m, 1_m), std::invalid_argument);
    CHECK_THROWS_AS(image_map(path, 1_m, Meters{-1}), std::invalid_argument);
    CHECK_THROWS_AS(image_map(path, Meters{std::numeric_limits<double>::quiet_NaN()}, 1_m),
                    std::invalid_argument);
    CHECK_THROWS_AS(image_map(folder.path("absent.png"), 1_m, 1_m), InputError);
}

}  // namespace occupancy_test
