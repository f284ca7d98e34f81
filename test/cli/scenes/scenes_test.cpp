// SPDX-License-Identifier: MIT
// links, scene, where, draw and move convert, as their user meets them.
#include "test/cli/process.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace scenes_test {
using namespace rovernet::test;

namespace {

/// Half the last digit of two that are compared by hand below.
constexpr double half_a_hundredth = 0.005;

bool near(double a, double b, double tolerance = half_a_hundredth) {
    return std::abs(a - b) <= tolerance;
}

const std::string pair = R"([scenario]
name = "pair"
duration = "100 s"
[radio]
essid = "search"
ip = "10.0.0.2"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["10 m", "0 m"]
heading = "90 deg"
radio = { ip = "10.0.0.9", power = "-20 dBm", sensitivity = "-80 dBm", mode = "master" }
move = { model = "goal", to = ["110 m", "0 m"], speed = "1 m/s" }
)";

/// 8 x 4 cells with a wall of one column in the middle.
std::string wall_picture() {
    PngPicture picture{.width = 8, .height = 4, .rows = {}};
    for (int row = 0; row < 4; ++row)
        picture.rows.push_back({255, 255, 255, 0, 255, 255, 255, 255});
    return png_bytes(picture);
}

/// 20 x 10 pixels, the walls of a hall of 16 x 8 in them: all around, and one across.
std::string hall_picture() {
    PngPicture picture{.width = 20, .height = 10, .rows = {}};
    for (int row = 0; row < 10; ++row) {
        std::vector<png_byte> pixels;
        for (int column = 0; column < 20; ++column) {
            const bool inside = column >= 2 && column < 18 && row >= 1 && row < 9;
            const bool edge = column == 2 || column == 17 || row == 1 || row == 8;
            pixels.push_back(inside && (edge || column == 10) ? 0 : 255);
        }
        picture.rows.push_back(std::move(pixels));
    }
    return png_bytes(picture);
}

/// A world of Stage with a map and two robots.
const std::string world = R"(
define robot position ( size [0.4 0.4] wifi ( model "raytrace" wall_factor 0.1 essid "x" ) )
model ( name "hall" bitmap "hall.png" size [16 8] )
robot ( name "one" pose [-6 0 90] )
robot ( name "two" pose [6 0 0] )
)";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE("links: the table of a robot lists the robots that it hears, with level and name") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const Json tables = json_of(folder, {"links", folder.path("pair.toml")});
    const Json& a = tables["robots"][0];
    const Json& b = tables["robots"][1];
    CHECK(a["ip"] == "10.0.0.2");
    CHECK(a["mac"] == "02:00:00:00:00:01");
    REQUIRE(b["links"].size() == 1);
    const Json& heard = b["links"][0];
    CHECK(heard["robot"] == "A");
    CHECK(heard["essid"] == "search");
    CHECK(heard["mode"] == "adhoc");
    // 16.53 dBm less 60.23 dB of free space over 10 m; -173.98 + 73.42 + 7 dBm of noise.
    CHECK(near(heard["level_dbm"], 16.532 - 60.231));
    CHECK(near(heard["noise_dbm"], -173.975 + 73.424 + 7));
    CHECK(heard["quality"] == 73);  // 2 (80 - 43.699)
    CHECK(a["links"].empty());      // B's -20 dBm arrive at -80.2 dBm; A needs -75
}

TEST_CASE("links: --robot prints the link table of one robot, and refuses an unknown robot") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const Ended ended = command(folder, {"links", folder.path("pair.toml"), "--robot", "B"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("ip 10.0.0.9") != std::string::npos);
    CHECK(ended.out.find("quality  73  level -43.70 dBm  noise -93.55 dBm") != std::string::npos);
    CHECK(ended.out.find("mac 02:00:00:00:00:02") != std::string::npos);
    CHECK(command(folder, {"links", folder.path("pair.toml"), "--robot", "C"}).exit == 2);
}

TEST_CASE("links: --history prints a CSV with a line for each link change") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair + "[propagation]\nmodel = \"disc\"\nrange = \"60 m\"\n");
    const Ended ended = command(folder, {"links", folder.path("pair.toml"), "--history"});
    const auto lines = lines_of(ended.out);
    REQUIRE(lines.size() == 5);
    CHECK(lines[0] == "time_s,from,to,event");
    CHECK(lines[1] == "0.000000000,A,B,up");
    CHECK(lines[2] == "0.000000000,B,A,up");
    CHECK(lines[3] == "50.000000001,A,B,down");  // the range itself is still inside
    CHECK(lines[4] == "50.000000001,B,A,down");
}

TEST_CASE("where: positions, speeds and headings are printed at several times") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const Json times =
        json_of(folder, {"where", folder.path("pair.toml"), "--at", "0,31.25s,1 min"});
    REQUIRE(times["times"].size() == 3);
    const Json& b = times["times"][1]["robots"][1];
    CHECK(times["times"][1]["t_s"] == 31.25);
    CHECK(b["name"] == "B");
    CHECK(near(b["x_m"], 41.25, 1e-9));
    CHECK(near(b["vx"], 1, 1e-9));
    CHECK(b["heading_rad"] == 0.0);
    CHECK(times["times"][2]["robots"][0]["vx"] == 0.0);
}

TEST_CASE("move convert: the positions in a written movement file equal those in the original") {
    const TemporaryFolder folder;
    folder.write("walk.tcl",
                 "$node_(0) set X_ 1\n$node_(0) set Y_ 2\n$node_(0) set Z_ 0\n"
                 "$ns_ at 1.0 \"$node_(0) setdest 11 2 2\"\n");
    for (const std::string out : {"copy.tcl", "copy.movements"}) {
        CAPTURE(out);
        REQUIRE(
            command(folder, {"move", "convert", folder.path("walk.tcl"), folder.path(out)}).exit ==
            0);
        const Json times = json_of(folder, {"where", folder.path(out), "--at", "0.5,3,7"});
        const Json& all = times["times"];
        CHECK(all[0]["robots"][0]["name"] == "n0");
        CHECK(near(all[0]["robots"][0]["x_m"], 1, 1e-6));
        CHECK(near(all[1]["robots"][0]["x_m"], 5, 1e-6));
        CHECK(near(all[2]["robots"][0]["x_m"], 11, 1e-6));
    }
    CHECK(
        command(folder, {"move", "convert", folder.path("walk.tcl"), folder.path("x.doc")}).exit ==
        2);
}

TEST_CASE(
    "move convert: from ns-2 to ns-2, node numbers stay the same; a notice lists changed names") {
    const TemporaryFolder folder;
    folder.write("five.tcl", "$node_(5) set X_ 1\n");
    folder.write("v.xml",
                 "<fcd-export>\n<timestep time=\"0\"><vehicle id=\"flow.0\" x=\"5\" y=\"1\"/>"
                 "<vehicle id=\"b\" x=\"9\" y=\"1\"/></timestep>\n</fcd-export>\n");
    const auto convert = [&](const std::string& from, const std::string& to) {
        return command(folder, {"move", "convert", folder.path(from), folder.path(to)}).err;
    };
    CHECK(convert("five.tcl", "a.tcl").find("numbers") == std::string::npos);
    CHECK(content(folder.path("a.tcl")).find("$node_(5) set X_") != std::string::npos);
    CHECK(convert("five.tcl", "a.movements").find("numbers instead of names: n5 is n0\n") !=
          std::string::npos);
    CHECK(convert("v.xml", "b.tcl").find("numbers instead of names: flow.0 is n0, b is n1\n") !=
          std::string::npos);
    CHECK(content(folder.path("b.tcl")).find("# flow.0 -> $node_(0)\n# b -> $node_(1)\n") !=
          std::string::npos);
}

TEST_CASE("scene: a file with neither a map nor robots is refused") {
    const TemporaryFolder folder;
    for (const std::string text : {"", "# nothing\n", "[radio]\nrate = \"1 Mb/s\"\n"}) {
        const Ended empty = command(folder, {"scene", folder.write("empty", text)});
        CHECK(empty.exit == 3);
        CHECK(empty.err.find("empty: the scenario: the key \"robot\" is missing; for example "
                             "[[robot]] with a name and a place, or [scene] with a map") !=
              empty.err.npos);
    }
}

TEST_CASE(
    "scene: an image is refused without --size; with --size, its walls and free area are printed") {
    const TemporaryFolder folder;
    folder.write("m.png", wall_picture());
    const Ended without = command(folder, {"scene", folder.path("m.png")});
    CHECK(without.exit == 3);
    CHECK(without.err.find("--size") != std::string::npos);
    const Json scene = json_of(folder, {"scene", folder.path("m.png"), "--size", "16x8"});
    CHECK(scene["size_m"] == Json({16.0, 8.0}));
    CHECK(scene["occupied_cells"] == 4);
    REQUIRE(scene["walls"].size() == 1);
    CHECK(scene["walls"][0]["corners"][0]["x_m"] == 6.0);
    CHECK(near(scene["free_area_m2"], 112, 1e-9));
}

TEST_CASE("scene: describes the robots of a scenario and the links between them") {
    const TemporaryFolder folder;
    folder.write("line.toml", R"(robot = [{ name = "a", at = ["0 m", "0 m"] },
        { name = "b", at = ["9 m", "0 m"] }, { name = "c", at = ["18 m", "0 m"] },
        { name = "far", at = ["99 m", "0 m"] }]
[propagation]
model = "disc"
range = "10 m"
)");
    const Json scene = json_of(folder, {"scene", folder.path("line.toml")});
    const Json& joined = scene["connectivity"];
    CHECK(joined["components"] == Json({{"a", "b", "c"}, {"far"}}));
    CHECK(joined["articulation_robots"] == Json({"b"}));
    CHECK(joined["diameter_hops"] == 2);
    CHECK(joined["links"] == 2);
    CHECK(scene["robots"][3]["x_m"] == 99.0);
}

TEST_CASE(
    "scene: the largest diameter of the connected parts is printed, whatever the robots' order") {
    const TemporaryFolder folder;
    folder.write("parts.toml", R"(robot = [{ name = "lone", at = ["500 m", "0 m"] },
        { name = "c", at = ["18 m", "0 m"] }, { name = "x", at = ["99 m", "0 m"] },
        { name = "a", at = ["0 m", "0 m"] }, { name = "d", at = ["27 m", "0 m"] },
        { name = "y", at = ["99 m", "5 m"] }, { name = "b", at = ["9 m", "0 m"] },
        { name = "z", at = ["95 m", "5 m"] }]
[propagation]
model = "disc"
range = "10 m"
)");
    const Json joined = json_of(folder, {"scene", folder.path("parts.toml")})["connectivity"];
    CHECK(joined["components"] == Json({{"lone"}, {"c", "a", "d", "b"}, {"x", "y", "z"}}));
    CHECK(joined["articulation_robots"] == Json({"c", "b"}));
    CHECK(joined["diameter_hops"] == 3);
    CHECK(joined["links"] == 6);
}

TEST_CASE("worlds: a Stage world is accepted as FILE by every command") {
    const TemporaryFolder folder;
    folder.write("hall.png", hall_picture());
    folder.write("w.world", world);
    const std::string file = folder.path("w.world");
    const Json scene = json_of(folder, {"scene", file});
    CHECK(scene["robots"].size() == 2);
    CHECK(scene["size_m"] == Json({16.0, 8.0}));  // the walls' bounding box, not the picture
    CHECK(scene["connectivity"]["components"].size() == 1);
    const Json link = json_of(folder, {"link", file, "one", "two"});
    CHECK(near(link["wall_m"], 1, 1e-9));
    CHECK(near(link["walls"][0]["entry_m"], 6, 1e-9));
    const Json turned = json_of(folder, {"where", file, "--at", "0"});
    CHECK(near(turned["times"][0]["robots"][0]["heading_rad"], 1.5707963267948966, 1e-12));
    CHECK(command(folder, {"run", file, "--out", folder.path("out")}).exit == 0);
}

TEST_CASE(
    "worlds: the error for a missing bitmap lists the paths tried; --bitmap names a replacement") {
    const TemporaryFolder folder;
    folder.write("other.png", hall_picture());
    folder.write("w.world", world);
    const std::string file = folder.path("w.world");
    const Ended missing = command(folder, {"links", file, "--world-path", folder.path("maps")});
    CHECK(missing.exit == 3);
    CHECK(missing.err.find("hall.png") != std::string::npos);
    CHECK(missing.err.find("maps") != std::string::npos);
    CHECK(command(folder, {"links", file, "--bitmap", "hall.png=other.png"}).exit == 0);
    CHECK(command(folder, {"links", file, "--lenient"}).exit == 0);
}

TEST_CASE("worlds: robots of a scenario override robots of the same name in its Stage world") {
    const TemporaryFolder folder;
    folder.write("hall.png", hall_picture());
    folder.write("w.world", world);
    folder.write("s.toml", R"([scenario]
duration = "10 s"
[scene]
world = "w.world"
[[robot]]
name = "two"
radio = { power = "10 dBm" }
move = { model = "fixed" }
[[robot]]
name = "three"
at = ["-6.5 m", "2 m"]
[[traffic]]
from = "one"
payload = "F"
)");
    const Json scene = json_of(
        folder, {"scene", folder.path("s.toml"), "--set", "robot.one.radio.power=\"11 dBm\""});
    REQUIRE(scene["robots"].size() == 3);
    CHECK(near(scene["robots"][0]["power_dbm"], 11));
    CHECK(near(scene["robots"][1]["power_dbm"], 10));
    CHECK(scene["robots"][1]["essid"] == "x");
    CHECK(scene["robots"][2]["name"] == "three");
    const Ended printed = command(folder, {"run", folder.path("s.toml"), "--print-scenario"});
    folder.write("again.toml", printed.out);
    const Ended again = command(folder, {"run", folder.path("again.toml"), "--print-scenario"});
    CHECK(again.out == printed.out);
}

TEST_CASE("scene: a robot whose name has a dot, as in flows of SUMO, may have its own radio") {
    const TemporaryFolder folder;
    folder.write("v.xml",
                 "<fcd-export>\n<timestep time=\"0\">"
                 "<vehicle id=\"flow.0\" x=\"5\" y=\"0\"/><vehicle id=\"flow.1\" x=\"9\" y=\"0\"/>"
                 "</timestep>\n</fcd-export>\n");
    const std::string movement = "[movement]\nfile = \"v.xml\"\n[[robot]]\n";
    const std::string file =
        folder.write("s.toml", movement + "name = \"flow.0\"\nradio = { power = \"7 dBm\" }\n");
    CHECK(near(json_of(folder, {"scene", file})["robots"][0]["power_dbm"], 7));
    const Json set =
        json_of(folder, {"scene", file, "--set", "robot.\"flow.0\".radio.power=\"11 dBm\""});
    CHECK(set["robots"][0]["name"] == "flow.0");
    CHECK(near(set["robots"][0]["power_dbm"], 11));
    const Ended printed = command(folder, {"run", file, "--print-scenario"});
    folder.write("again.toml", printed.out);
    CHECK(command(folder, {"run", folder.path("again.toml"), "--print-scenario"}).out ==
          printed.out);

    const auto refused = [&](const std::string& name) {
        folder.write("r.toml", movement + "name = " + name + "\nat = [\"0 m\", \"0 m\"]\n");
        return command(folder, {"scene", folder.path("r.toml")}).err;
    };
    CHECK(refused("\"flow.2\"")
              .find("without dots and quotes; only robots of a movement file may have names with "
                    "dots") != std::string::npos);
    CHECK(refused("'flow\"0'").find("without dots and quotes\n") != std::string::npos);
}

TEST_CASE("where: absent robots are marked, and times are printed in the given order") {
    const TemporaryFolder folder;
    folder.write("v.xml",
                 "<fcd-export>\n"
                 "<timestep time=\"1\"><vehicle id=\"v\" x=\"5\" y=\"0\"/></timestep>\n"
                 "<timestep time=\"2\"><vehicle id=\"v\" x=\"9\" y=\"0\"/></timestep>\n"
                 "<timestep time=\"4\"></timestep>\n</fcd-export>\n");
    const Json times = json_of(folder, {"where", folder.path("v.xml"), "--at", "5s,1.5s,0.5s"});
    const std::vector<std::string> expected{"left", "on", "not_departed"};
    const std::vector<double> at{5, 1.5, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(times["times"][i]["t_s"] == at[i]);
        CHECK(times["times"][i]["robots"][0]["presence"] == expected[i]);
    }
    const std::string text =
        command(folder, {"where", folder.path("v.xml"), "--at", "5s,1.5s,0.5s"}).out;
    CHECK(text.find("rad, left\n") < text.find("rad\n"));
    CHECK(text.find("rad\n") < text.find("rad, not departed\n"));
    const Json scene = json_of(folder, {"scene", folder.path("v.xml"), "--at", "0.5s"});
    CHECK(scene["robots"][0]["presence"] == "not_departed");
    CHECK(scene["robots"][0]["on"] == false);
}

TEST_CASE("where, link, links, scene, draw: a time after the end of the run gives a notice") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const std::string file = folder.path("pair.toml");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"where", file},
                                                  {"link", file, "A", "B"},
                                                  {"links", file},
                                                  {"scene", file},
                                                  {"draw", file, "-o", folder.path("late.svg")}}) {
        std::vector<std::string> late = words, in_time = words;
        late.insert(late.end(), {"--at", "101s"});
        in_time.insert(in_time.end(), {"--at", "100s"});
        const Ended ended = command(folder, late);
        CHECK(ended.exit == 0);
        CHECK(ended.err.find("the run ends at 100 s") != std::string::npos);
        CHECK(command(folder, in_time).err.empty());
    }
}

TEST_CASE("draw: robots of a movement file are drawn, with and without [[robot]] tables") {
    const TemporaryFolder folder;
    folder.write("mv.tcl",
                 "$node_(0) set X_ 1\n$node_(0) set Y_ 2\n$node_(1) set X_ 50\n"
                 "$node_(1) set Y_ 2\n$ns_ at 1.0 \"$node_(0) setdest 11 2 2\"\n");
    folder.write("s.toml",
                 "[movement]\nfile = \"mv.tcl\"\n[[robot]]\nname = \"own\"\n"
                 "at = [\"9 m\", \"9 m\"]\n");
    for (const char* file : {"mv.tcl", "s.toml"}) {
        const Ended ended =
            command(folder, {"draw", folder.path(file), "--at", "2s", "--coverage", "n1", "--links",
                             "--trails", "--axes", "-o", folder.path("out.svg")});
        CHECK(ended.exit == 0);
        const std::string svg = content(folder.path("out.svg"));
        CHECK(svg.find("coverage of n1") != std::string::npos);
        CHECK(svg.find(">n0</text>") != std::string::npos);
    }
}

TEST_CASE("draw: writes a complete picture or none, with the same bytes each time") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    for (const std::string out : {"a.svg", "b.svg"}) {
        REQUIRE(command(folder, {"draw", folder.path("pair.toml"), "--at", "10s", "--coverage", "A",
                                 "--links", "--trails", "-o", folder.path(out)})
                    .exit == 0);
    }
    const std::string svg = content(folder.path("a.svg"));
    CHECK(svg.starts_with("<"));
    CHECK(svg == content(folder.path("b.svg")));
    CHECK(command(folder, {"draw", folder.path("pair.toml"), "-o", folder.path("c.gif")}).exit ==
          2);
    CHECK(command(folder,
                  {"draw", folder.path("pair.toml"), "--coverage", "Z", "-o", folder.path("d.svg")})
              .exit == 2);
    CHECK_FALSE(std::filesystem::exists(folder.path("d.svg")));
}

}  // namespace scenes_test
