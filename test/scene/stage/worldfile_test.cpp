// SPDX-License-Identifier: MIT
#include "scene/stage/worldfile.hpp"

#include "scene/stage/world_model.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace worldfile_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

/// What a world file says wrong: "line:column: message", or "" if nothing.
std::string mistake(const std::string& text, const WorldOptions& options = {}) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.world", text);
    try {
        read_worldfile(path, options);
    } catch (const InputError& error) {
        const Location& where = error.where();
        const std::string place = where.source == path ? "" : where.source + ":";
        return place + std::to_string(where.line) + ":" + std::to_string(where.column) + ": " +
               error.message();
    }
    return "";
}

WorldFile read(const std::string& text) {
    const TemporaryFolder folder;
    return read_worldfile(folder.write("a.world", text), {});
}

/// The values of a property as text: "1 2", "a"; "none" if it is not there.
std::string value(const WorldEntity& entity, const std::string& key) {
    const WorldProperty* property = entity.find(key);
    if (!property) return "none";
    std::string out;
    for (const auto& atom : property->values) {
        if (!out.empty()) out += ' ';
        if (const auto* text = std::get_if<std::string>(&atom)) out += *text;
        if (const auto* number = std::get_if<double>(&atom)) {
            out += std::to_string(static_cast<int>(std::lround(*number * 1000)));
        }
    }
    return out;
}

/// STAGEPATH for the life of the object.
struct StagePath {
    explicit StagePath(const std::string& folders) { setenv("STAGEPATH", folders.c_str(), 1); }
    ~StagePath() { unsetenv("STAGEPATH"); }
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "worldfile: keys, texts, tuples and nested models are read in order, with line and column") {
    const WorldFile world = read(
        "# a comment\n"
        "size [16 -.5 +3.]\tname \"a b\" # two on a line\r\n"
        "model\n"
        "(\n"
        "  color \"red\" laser() pose [ ]\r"
        "  position( size [1 \"x\"] )\n"
        ")");
    CHECK(value(world.root, "size") == "16000 -500 3000");
    CHECK(value(world.root, "name") == "a b");
    CHECK(world.root.find("name")->where.line == 2);
    CHECK(world.root.find("name")->where.column == 19);
    REQUIRE(world.root.children.size() == 1);
    const WorldEntity& model = world.root.children[0];
    CHECK(model.type == "model");
    CHECK(model.macro.empty());
    CHECK(model.where.line == 3);
    CHECK(model.where.column == 1);
    CHECK(model.find("pose")->is_tuple);
    CHECK(model.find("pose")->values.empty());
    REQUIRE(model.children.size() == 2);
    CHECK(model.children[0].type == "laser");
    CHECK(model.children[1].type == "position");
    CHECK(model.children[1].where.line == 6);
    CHECK(value(model.children[1], "size") == "1000 x");
    CHECK(world.notices.empty());
}

TEST_CASE("worldfile: a line end of any kind counts as one line end") {
    for (const std::string end : {"\n", "\r", "\r\n", "\n\r"}) {
        CAPTURE(end.size());
        CHECK(mistake("a 1" + end + "b 2" + end + ",").starts_with("3:1: "));
        CHECK(mistake("a 1" + end + end + end + ",").starts_with("4:1: "));
    }
}

TEST_CASE("worldfile: a word with brackets, dots or hyphens, such as spose[12], is a key") {
    const WorldFile world = read("polygon[0].point[3] [0.5 1]\nspose[12] [1 2 3]\nscount-a_b 4\n");
    CHECK(value(world.root, "polygon[0].point[3]") == "500 1000");
    CHECK(value(world.root, "spose[12]") == "1000 2000 3000");
    CHECK(value(world.root, "scount-a_b") == "4000");
}

TEST_CASE("worldfile: if a key is given several times, its last value counts") {
    CHECK(value(read("a 1\na 2\na 3\n").root, "a") == "3000");
}

TEST_CASE(
    "worldfile: a model made from a macro has the macro's keys and children besides its own") {
    const WorldFile world = read(
        "define base position ( size [1 1] color \"red\" laser() )\n"
        "define robot base\n( color \"blue\" mass 3 sonar() )\n"
        "define sonar ranger ( scount 16 )\n"
        "robot ( mass 4 wifi() )\n");
    REQUIRE(world.root.children.size() == 1);
    const WorldEntity& robot = world.root.children[0];
    CHECK(robot.type == "position");
    CHECK(robot.macro == "robot");
    CHECK(robot.where.line == 5);
    CHECK(value(robot, "size") == "1000 1000");
    CHECK(value(robot, "color") == "blue");
    CHECK(value(robot, "mass") == "4000");
    CHECK(robot.find("size")->where.line == 1);
    REQUIRE(robot.children.size() == 3);
    CHECK(robot.children[0].type == "laser");
    CHECK(robot.children[1].type == "ranger");
    CHECK(robot.children[1].macro == "sonar");
    CHECK(value(robot.children[1], "scount") == "16000");
    CHECK(robot.children[2].type == "wifi");
    CHECK(world.notices.empty());
}

TEST_CASE("worldfile: if a macro is defined twice, the first definition counts, with a notice") {
    const WorldFile world = read(
        "define m model ( a 1 )\n"
        "define m position ( a 2 )\n"
        "m()\n");
    CHECK(world.root.children[0].type == "model");
    CHECK(value(world.root.children[0], "a") == "1000");
    REQUIRE(world.notices.size() == 1);
    CHECK(contains(world.notices[0],
                   "a.world:2: macro \"m\" is defined a second time; the first definition, at"));
}

TEST_CASE(
    "worldfile: a type that Stage does not know causes one notice, with the nearest known type") {
    const WorldFile world = read(
        "define commbot position ( size [1 1] )\n"
        "commbott ( )\ncommbott ( )\nrover ( wifi() )\nplan ( bitmap \"a.png\" )\n");
    REQUIRE(world.notices.size() == 3);
    CHECK(contains(world.notices[0],
                   ":2: unknown type \"commbott\", and there is no macro of this name; this entry "
                   "is ignored; did you mean \"commbot\"?"));
    CHECK(contains(world.notices[1], ":4: unknown type \"rover\""));
    CHECK(contains(world.notices[1],
                   "treated as if its type were position, because it contains a wifi model"));
    CHECK(contains(world.notices[2], "treated as if its type were model, because it has a bitmap"));
    CHECK(world_role(world.root.children[0]) == WorldRole::ignored);
    CHECK(world_role(world.root.children[2]) == WorldRole::robot);
    CHECK(world_role(world.root.children[3]) == WorldRole::wall);
}

TEST_CASE("worldfile: of a malformed number such as 3.75.2, the number at its beginning is read") {
    const WorldFile world = read("position ( pose [3.75.2 -1-2 +.5. 0] size [4 5.-] a 6.0.0.1 )\n");
    const WorldPose pose = world_pose(world.root.children[0], "pose", {});
    CHECK(pose.at.x == 3.75);
    CHECK(pose.at.y == -1);
    CHECK(pose.at.z == 0.5);
    CHECK(world_size(world.root.children[0], {}).y == 5);
    CHECK(world.root.children[0].find("a")->number() == 6);
    REQUIRE(world.notices.size() == 5);
    CHECK(
        world.notices[0].ends_with("a.world:1: \"3.75.2\" is read as 3.75, as in Stage; the "
                                   "characters after this number are ignored"));
}

TEST_CASE("worldfile: a tuple may continue over several lines, with comments") {
    const WorldFile world = read("position ( pose [ 1\r\n 2 # two\n\n 3\n] name \"a\" )\n");
    const WorldPose pose = world_pose(world.root.children[0], "pose", {});
    CHECK(pose.at.x == 1);
    CHECK(pose.at.y == 2);
    CHECK(pose.degrees == 3);
    CHECK(world.root.children[0].find("name")->where.line == 5);
}

TEST_CASE(
    "worldfile: the message of a syntax error has line, column, what was found and what to write") {
    CHECK(mistake("size [16 16]\n power 1e-3\n") ==
          "2:8: found \"1e-3\"; expected a number without an exponent; write 0.001");
    CHECK(mistake("power 2.5E2\n") ==
          "1:7: found \"2.5E2\"; expected a number without an exponent; write 250");
    CHECK(mistake("size [16, 16]\n") ==
          "1:9: found \",\"; expected blanks between values; write for example [1 2 3]");
    CHECK(mistake("size [16 16];\n") ==
          "1:13: found \";\"; expected a blank or a new line; remove the \";\"");
    CHECK(mistake("name 'a'\n") ==
          "1:6: found \"'\"; expected a text in double quotes; write \"...\"");
    CHECK(mistake("model (\n size [16 16\n pose [0 0 0]\n)\n") ==
          "3:2: found the word \"pose\" inside the [ ] of \"size\"; expected numbers or texts, and "
          "then the \"]\"; add the \"]\"");
    CHECK(mistake("size [16\n\n").starts_with("3:1: found the end of the file inside the [ ]"));
    CHECK(mistake("a [b]\n") ==
          "1:4: found the word \"b\" inside the [ ] of \"a\"; expected numbers or texts, and then "
          "the \"]\"; put a text in quotes");
    CHECK(mistake("model (\n a 1\n")
              .starts_with(
                  "3:1: found the end of the file; expected the \")\" that closes the \"(\" at "));
    CHECK(mistake("model (\n a 1\n").ends_with("a.world:1:7; add the \")\""));
    CHECK(mistake("model ( a 1 ) )\n") ==
          "1:15: found \")\" without a \"(\"; expected a key, a model or the end of the file; "
          "remove the \")\"");
    CHECK(mistake("resolution\n0.02\n") ==
          "1:11: found the end of the line; expected the value of \"resolution\" on the same line: "
          "a number, a text in quotes or [values]; or a \"(\" that begins a block; write "
          "resolution 1, or resolution ( ... )");
    CHECK(mistake("localization gps\n") ==
          "1:14: found the word \"gps\"; expected the value of \"localization\" on the same line: "
          "a number, a text in quotes or [values]; or a \"(\" that begins a block; did you mean "
          "\"gps\", in quotes?");
    CHECK(mistake("a 1\n5\n") ==
          "2:1: found the number 5; expected a key or the type of a model; write \"name value\" or "
          "\"type ( ... )\"");
    CHECK(mistake("name \"abc\n\"\n") ==
          "1:6: found a text without its end; expected \" at both ends of a text, on one line; add "
          "the second \"");
    CHECK(mistake("size[16 16]\n") ==
          "1:1: found \"size[16\"; expected a key and its value with a blank between them; write "
          "size [...]");
    CHECK(mistake("range 4m\n").starts_with("1:7: found \"4m\"; expected a number, such as -0.5"));
    CHECK(mistake("range -\n").starts_with("1:7: found \"-\"; expected a number"));
    CHECK(mistake("range +-5\n").starts_with("1:7: found \"+-5\"; expected a number"));
    CHECK(mistake("a = 5\n").starts_with("1:3: found \"=\""));
    CHECK(mistake("<sdf>\n").starts_with("1:1: found \"<\"; expected a world of Stage"));
    CHECK(mistake("// x\n").starts_with("1:1: found \"/\""));
    CHECK(mistake("model { }\n").starts_with("1:7: found \"{\""));
    CHECK(mistake("a 1 \x01\n").starts_with("1:5: found the byte 0x01;"));
    CHECK(mistake("name \"a\xE9z\"\n").starts_with("1:8: found the byte 0xE9 in a text;"));
    CHECK(mistake("power " + std::string(400, '9') + "\n").starts_with("1:7: found \"999"));
    CHECK(mistake("name \"\xC3\xA9\"\n") == "");  // e with an accent, as UTF-8
    CHECK(mistake("name \"" + std::string(4096, 'a') + "\"\n") == "");
    CHECK(mistake("name \"" + std::string(4097, 'a') + "\"\n")
              .starts_with("1:6: found a word or text of 4097 bytes; expected at most 4096"));
    CHECK(mistake(std::string(5000, 'a')).starts_with("1:1: found a word or text of 5000 bytes"));
    CHECK(mistake("# caf\xE9, ; ' 1e5\n") == "");
}

TEST_CASE("worldfile: an incomplete `define` (definition of a macro) is refused") {
    CHECK(mistake("define robot ( )\n") ==
          "1:14: found \"(\"; expected the macro's name and its type; write define robot position "
          "( ... )");
    CHECK(
        mistake("define \"x\" model ()\n").starts_with("1:8: found the text \"x\"; expected the"));
    CHECK(mistake("define a model 5\n") ==
          "1:16: found the number 5; expected \"(\" after \"define a model\"; write define a model "
          "( ... )");
    CHECK(mistake("define a model ( size [1 \n").starts_with("2:1: "));  // though nobody uses it
    CHECK(mistake("define a model ( define b model ( ) )\n").starts_with("1:"));
}

TEST_CASE(
    "worldfile: included files are searched beside the world, in the search path, then in "
    "STAGEPATH") {
    const TemporaryFolder folder;
    for (const std::string sub : {"world", "first", "second"}) {
        std::filesystem::create_directory(folder.path(sub));
    }
    folder.write("second/map.inc", "where \"second\"\n");
    const std::string path = folder.write("world/a.world", "include \"inc/map.inc\"\nb 2\n");
    const StagePath stage_path(":" + folder.path("none") + ":" + folder.path("second"));
    CHECK(value(read_worldfile(path, {}).root, "where") == "second");
    folder.write("first/map.inc", "where \"first\"\n");
    const WorldOptions options{.search_path = {folder.path("first")}};
    const WorldFile found = read_worldfile(path, options);
    CHECK(value(found.root, "where") == "first");
    CHECK(value(found.root, "b") == "2000");
    CHECK(found.root.find("where")->where.source == folder.path("first/map.inc"));
    folder.write("world/map.inc", "where \"beside\"\n");
    CHECK(value(read_worldfile(path, options).root, "where") == "beside");
}

TEST_CASE(
    "worldfile: the error for a missing included file lists the paths that were tried; with "
    "--lenient it is only a notice") {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.world", "a 1\ninclude \"inc/m.inc\"\nb 2\n");
    WorldOptions options{.search_path = {folder.path("lib")}};
    std::string message;
    try {
        read_worldfile(path, options);
    } catch (const InputError& error) {
        message = error.message();
        CHECK(error.where().line == 2);
        CHECK(error.where().column == 9);
    }
    const std::string places = folder.path("inc/m.inc") + ", " + folder.path("lib/inc/m.inc") +
                               ", " + folder.path("m.inc") + " and " + folder.path("lib/m.inc");
    CHECK(message == "no file \"inc/m.inc\" to include; tried the paths " + places +
                         "; give the file's folder with --world-path or in the variable STAGEPATH");
    options.lenient = true;
    const WorldFile world = read_worldfile(path, options);
    CHECK(value(world.root, "b") == "2000");
    REQUIRE(world.notices.size() == 1);
    CHECK(world.notices[0] ==
          path +
              ":2: the include file \"inc/m.inc\" is missing, so it is left out; tried the paths " +
              places);
}

TEST_CASE(
    "worldfile: macros of an included file can be used after the include, and errors name the "
    "included file") {
    const TemporaryFolder folder;
    folder.write("m.inc", "define m model ( a 1 )\n");
    const std::string path =
        folder.write("a.world", "include \"m.inc\"\nm ( include \"k.inc\"\n)\n");
    folder.write("k.inc", "b 2");
    const WorldFile world = read_worldfile(path, {});
    CHECK(value(world.root.children[0], "a") == "1000");
    CHECK(value(world.root.children[0], "b") == "2000");
    folder.write("k.inc", "\n  b ,");
    try {
        read_worldfile(path, {});
        CHECK(false);
    } catch (const InputError& error) {
        CHECK(error.where().text() == folder.path("k.inc") + ":2:5");
    }
}

TEST_CASE("worldfile: an `include` must name a file, and nothing may follow on the same line") {
    CHECK(mistake("include map\n") ==
          "1:9: found the word \"map\"; expected the name of a file in quotes; write include "
          "\"map.inc\"");
    CHECK(mistake("include \"a.inc\" b 1\n") ==
          "1:17: found the word \"b\"; expected nothing after an include; begin a new line");
    CHECK(mistake("include \"\"\n").starts_with("1:9: found the text \"\"; expected the name"));
}

TEST_CASE("worldfile: a file that includes itself, and macros that expand too far, are errors") {
    CHECK(contains(mistake("include \"a.world\"\n"), "1:9: "));
    CHECK(contains(mistake("include \"a.world\"\n"), "includes itself"));
    const std::string deep = "is nested more than 64 levels deep";
    CHECK(contains(mistake("define a a ( )\na ( )\n"), "2:1: \"a\" " + deep));
    CHECK(contains(mistake("define a model ( a ( ) )\na ( )\n"), "1:18: \"a\" " + deep));
    CHECK(contains(mistake("define a b ( )\ndefine b a ( )\nb ( )\n"), deep));
    std::string doubling = "define m0 model ( a 1 )\n";
    for (int i = 1; i <= 40; ++i) {
        const std::string before = "m" + std::to_string(i - 1);
        doubling +=
            "define m" + std::to_string(i) + " model ( " + before + "() " + before + "() )\n";
    }
    CHECK(contains(mistake(doubling + "m40 ( )\n"), "the expanded macros have more than 1000000"));
    std::string nested;
    for (int i = 0; i < 65; ++i) nested += "model (";
    CHECK(contains(mistake(nested), "1:449: \"model\" " + deep));
    CHECK(mistake(nested.substr(7) + std::string(64, ')')) == "");
    std::string many;
    for (int i = 0; i < 400'000; ++i) many += "a 1\n";
    CHECK(contains(mistake(many), "more than 1000000 words, values and lines"));
}

TEST_CASE("worldfile: included files may be nested at most 16 deep") {
    const TemporaryFolder folder;
    const auto write = [&](int depth) {
        for (int i = 0; i < depth; ++i) {
            folder.write(std::to_string(i), "include \"" + std::to_string(i + 1) + "\"\n");
        }
        return folder.write(std::to_string(depth), "a 1\n");
    };
    write(16);
    CHECK(value(read_worldfile(folder.path("0"), {}).root, "a") == "1000");
    write(17);
    CHECK_THROWS_AS(read_worldfile(folder.path("0"), {}), InputError);
}

TEST_CASE("worldfile: a file that is missing, too large or not a world file is refused") {
    const TemporaryFolder folder;
    const auto message = [](const std::string& path) -> std::string {
        try {
            read_worldfile(path, {});
        } catch (const InputError& error) {
            return error.message();
        }
        return "";
    };
    CHECK(message(folder.path("none")).starts_with("no such file; expected a world file"));
    CHECK(message(folder.path("")).starts_with("is not a regular file; expected a world file"));
    const std::string large = folder.path("large.world");
    folder.write("large.world", "");
    std::filesystem::resize_file(large, (16 << 20) + 1);
    CHECK(message(large).starts_with("is too large; expected at most 16 MiB in each file"));
    CHECK(message(folder.write("nul.world", std::string("a 1\n\0b", 6))) ==
          "found the byte 0x00; expected a key or a value; is this a world file?");
    CHECK(read_worldfile(folder.write("empty.world", ""), {}).root.children.empty());
}

TEST_CASE("worldfile: poses of Stage 2 and Stage 4 are distinguished by their number of values") {
    const WorldFile world = read(
        "model ( pose [1 2 90] size [3 4] )\n"
        "model ( pose [1 2 5 90] size [3 4 6] )\n"
        "model ( pose [1 2] )\n"
        "model ( )\n");
    const auto& models = world.root.children;
    const WorldUnits units = world_units(world);
    for (const auto& model : {models[0], models[1]}) {
        const WorldPose pose = world_pose(model, "pose", units);
        CHECK(pose.at.x == 1);
        CHECK(pose.at.y == 2);
        CHECK(pose.degrees == 90);
        CHECK(world_size(model, units).x == 3);
        CHECK(world_size(model, units).y == 4);
    }
    CHECK(world_pose(models[1], "pose", units).at.z == 5);
    CHECK(world_pose(models[2], "pose", units).at == Vec3{1, 2, 0});
    CHECK(world_pose(models[3], "pose", units).at == Vec3{});
    CHECK(world_size(models[3], units).x == 0.4);
}

TEST_CASE("worldfile: lengths in cm and mm equal those in metres, to the last bit") {
    const WorldUnits cm = world_units(read("unit_length \"cm\"\n"));
    const WorldUnits mm = world_units(read("unit_length \"mm\"\n"));
    CHECK(cm.metres(3730) == 37.3);
    CHECK(cm.metres(3730.3) == 37.303);
    CHECK(mm.metres(-4.7) == -0.0047);
    int wrong = 0;
    for (int n = 1; n < 10'000; ++n) {
        wrong += cm.metres(n) != n / 100.0;
        wrong += mm.metres(n) != n / 1000.0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("worldfile: unit_length and unit_angle apply to lengths and angles") {
    const WorldFile world = read(
        "unit_length \"cm\"\nunit_angle \"radians\"\nmodel ( pose [100 250 1.5] size [20 40] )\n");
    const WorldUnits units = world_units(world);
    const WorldPose pose = world_pose(world.root.children[0], "pose", units);
    constexpr double rounding = 1e-13;  // of one product
    CHECK(std::abs(pose.at.x - 1) < rounding);
    CHECK(std::abs(pose.at.y - 2.5) < rounding);
    CHECK(std::abs(pose.degrees - 85.94366926962348) < rounding * 100);
    CHECK(std::abs(world_size(world.root.children[0], units).y - 0.4) < rounding);
    CHECK_THROWS_WITH_AS(world_units(read("unit_length \"inch\"\n")),
                         doctest::Contains("expected one of \"m\", \"cm\", \"mm\"; write m"),
                         InputError);
    CHECK_THROWS_WITH_AS(world_units(read("unit_angle \"degree\"\n")),
                         doctest::Contains("did you mean \"degrees\"?"), InputError);
}

TEST_CASE("worldfile: an invalid pose or size is refused, with line and column") {
    const auto refused = [](const std::string& body) -> std::string {
        const WorldFile world = read("model (\n " + body + " )\n");
        try {
            world_pose(world.root.children[0], "pose", {});
            world_size(world.root.children[0], {});
        } catch (const InputError& error) {
            return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) +
                   ": " + error.message();
        }
        return "";
    };
    CHECK(refused("pose [1 2 3 4 5]") ==
          "2:2: pose: found 5 numbers; expected [x y a] or [x y z a]; write pose [x y a]");
    CHECK(refused("pose [1 \"2\" 3]").starts_with("2:2: pose: found a text; expected [x y a]"));
    CHECK(refused("pose 5").starts_with("2:2: pose: found a single value; expected"));
    CHECK(refused("size [1]") ==
          "2:2: size: found 1 numbers; expected [x y] or [x y z]; write size [x y]");
    CHECK(refused("size [1 -1]").starts_with("2:2: size: found 1 m x -1 m; expected lengths >= 0"));
    CHECK(refused("pose [9999999999 0 0]").starts_with("2:2: pose: found 9999999999 m; expected"));
    CHECK(refused("pose [1 2 3] size [1 1]") == "");
    CHECK(refused("size [5 1.5 0.5 0]") == "");  // the first ones count, as in Stage
}

TEST_CASE("worldfile: poses are composed by rotation, then translation") {
    const WorldPose outer{{10, 20, 0}, 90};
    const WorldPose inner{{3, 4, 1}, 45};
    const WorldPose both = outer * inner;
    CHECK(both.at.x == 6);  // exactly: quarter turns have no rounding
    CHECK(both.at.y == 23);
    CHECK(both.degrees == 135);
    const WorldPose oblique = WorldPose{{0, 0, 0}, 30} * WorldPose{{2, 0, 0}, 0};
    constexpr double rounding = 1e-15;
    CHECK(std::abs(oblique.at.x - std::sqrt(3.0)) < 2 * rounding);
    CHECK(std::abs(oblique.at.y - 1) < rounding);
    CHECK(direction(-90).sine == -1);
    CHECK(direction(630).cosine == 0);
    CHECK(direction(-180).cosine == -1);
}

}  // namespace worldfile_test
