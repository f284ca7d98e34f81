// SPDX-License-Identifier: MIT
#include "mobility/files/bonnmotion.hpp"

#include "test/mobility/files/playback.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace bonnmotion_test {
using namespace rovernet;
using test::movement_error;
using test::Playback;
using test::TemporaryFolder;

namespace {

/// A few roundings of coordinates up to 1 km.
constexpr double tolerance = 1e-9;  // [m] or [m/s]

bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

Playback played(const std::string& text, const std::string& params = "") {
    const TemporaryFolder folder;
    if (!params.empty()) folder.write("scen.params", params);
    return Playback(folder.write("scen.movements", text));
}
std::string error_of(const std::string& text, const std::string& params = "") {
    const TemporaryFolder folder;
    if (!params.empty()) folder.write("scen.params", params);
    return movement_error(folder.write("scen.movements", text));
}
std::string zipped(const std::string& text) {
    const TemporaryFolder folder;
    const std::string path = folder.path("zipped.gz");
    gzFile file = gzopen(path.c_str(), "wb");
    REQUIRE(gzwrite(file, text.data(), static_cast<unsigned>(text.size())) ==
            static_cast<int>(text.size()));
    gzclose(file);
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

const std::string two_nodes =
    "0.0 1.0 2.0 10.0 11.0 2.0 15.0 11.0 2.0 20.0 11.0 12.0\n"
    "0.0 5.0 5.0 4.0 5.0 1.0\n";

}  // namespace

TEST_CASE("bonnmotion: a node is at each of its positions at the time given for it") {
    const auto p = played(two_nodes);
    REQUIRE(p.file.robots().size() == 2);
    CHECK(p.file.robots()[0].name == "n0");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 0});
    CHECK(p.file.robots()[1].name == "n1");
    CHECK(p.file.robots()[1].start == Vec3{5, 5, 0});
    CHECK(near(p.velocity("n0", 0), {1, 0, 0}));
    CHECK(near(p.position("n0", 4), {5, 2, 0}));
    CHECK(near(p.position("n0", 10), {11, 2, 0}));
    CHECK(near(p.velocity("n0", 12), {}));
    CHECK(near(p.position("n0", 15), {11, 2, 0}));
    CHECK(near(p.velocity("n0", 15), {0, 2, 0}));
    CHECK(near(p.position("n0", 99), {11, 12, 0}));
    CHECK(near(p.position("n1", 3), {5, 2, 0}));
    CHECK(p.file.end() == start_of_run + from_seconds(20));
}

TEST_CASE(
    "bonnmotion: commands are in the order of time, and at equal times in the order of the nodes") {
    const auto p = played(two_nodes);
    std::string order;
    for (const auto& c : p.commands) {
        CHECK(c.kind == MovementCommand::Kind::reach);
        CHECK(c.arrival > c.time);
        order += std::to_string(c.time.time_since_epoch().count() / 1'000'000'000) + ":" +
                 std::to_string(c.robot) + " ";
    }
    CHECK(order == "0:0 0:1 10:0 15:0 ");
    REQUIRE(p.file.notices().size() == 1);
    CHECK(p.file.notices()[0].ends_with(
        "scen.movements is not sorted by time, so 4 legs of the robots' paths are kept in memory"));
}

TEST_CASE(
    "bonnmotion: simultaneous commands of many nodes are in the order of the nodes in the file") {
    std::string text;
    for (int node = 0; node < 100; ++node) {
        text += "1 0 0 2 1 0 " + std::string(node % 3 == 0 ? "3 1 1 4 5 5" : "4 2 2") + "\n";
    }
    const auto p = played(text);
    int disorder = 0;
    for (std::size_t i = 1; i < p.commands.size(); ++i) {
        const auto& a = p.commands[i - 1];
        const auto& b = p.commands[i];
        disorder += a.time > b.time || (a.time == b.time && a.robot > b.robot);
    }
    CHECK(p.commands.size() == 100 * 3 + 34);
    CHECK(disorder == 0);
}

TEST_CASE("bonnmotion: a node whose first time is after the start appears at this time") {
    const auto p = played("2 1 1 4 3 1\n3 7 7\n");
    CHECK(p.file.robots()[0].appears == start_of_run + from_seconds(2));
    REQUIRE(p.commands.size() == 3);
    CHECK(p.commands[0].kind == MovementCommand::Kind::appear);
    CHECK(p.commands[0].to == Vec3{1, 1, 0});
    CHECK(p.commands[1].kind == MovementCommand::Kind::reach);
    CHECK(p.commands[2].kind == MovementCommand::Kind::appear);
    CHECK(p.commands[2].robot == 1);
    CHECK_FALSE(p.present("n0", 1));
    CHECK(near(p.position("n0", 3), {2, 1, 0}));
    CHECK(p.file.end() == start_of_run + from_seconds(4));
}

TEST_CASE("bonnmotion: positions with z are recognised by the number of values in a line") {
    const auto p = played("0 1 2 3 10 11 2 13\n0 4 5 6\n");
    REQUIRE(p.file.robots().size() == 2);
    CHECK(p.file.robots()[1].start == Vec3{4, 5, 6});
    CHECK(near(p.position("n0", 5), {6, 2, 8}));
}

TEST_CASE(
    "bonnmotion: 12 values in a line are read as 2-D positions if the times ascend, else as 3-D") {
    CHECK(near(played("0 5 5 1 6 6 2 7 7 3 8 8\n").position("n0", 3), {8, 8, 0}));
    CHECK(near(played("0 9 9 1 5 8 8 2 9 7 7 3\n").position("n0", 9), {7, 7, 3}));
    // One line decides for all.
    const auto p = played("0 1 2 3 4 5 6 7 8 9 10 11\n0 9 9 1\n");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 3});
}

TEST_CASE("bonnmotion: the .params file determines whether positions have a z") {
    const std::string twelve = "0 0 1 1 5 2 2 5 9 3 3 9\n";  // rising times either way
    CHECK(near(played(twelve).position("n0", 9), {3, 9, 0}));
    CHECK(near(played(twelve, "model=Static\nx=9.0\ny=9.0\n").position("n0", 9), {3, 9, 0}));
    const std::string z = "model=RandomWaypoint\nx=9.0\r\nz=9.0\r\n";
    CHECK(near(played(twelve, z).position("n0", 9), {3, 3, 9}));
    CHECK(near(played(twelve, z + "J=2D\n").position("n0", 9), {3, 9, 0}));
    CHECK(near(played(twelve, "J=3D\r\n").position("n0", 9), {3, 3, 9}));
    CHECK(played("0 1 2\n", "z=0.0\n").file.robots()[0].start == Vec3{1, 2, 0});
    CHECK(error_of("0 1 2 3\n", "model=Static\n") ==
          "scen.movements:1:8: found a line of 4 numbers, expected \"time x y\" once or more, so a "
          "multiple of 3 numbers");
}

TEST_CASE("bonnmotion: the status of nodes in the disaster area model is ignored") {
    const std::string params = "model=DisasterArea\nx=9.0\ny=9.0\n";
    CHECK(near(played("0 1 2 0 4 5 2 1\n", params).position("n0", 2), {3, 2, 0}));
    CHECK(near(played("0 1 2 7 0 4 5 2 7 1\n", params + "z=9\n").position("n0", 2), {3, 2, 7}));
}

TEST_CASE("bonnmotion: a gzip file is read like the plain file, whatever the file name") {
    const TemporaryFolder folder;
    const Playback p(folder.write("any.name", zipped(two_nodes)));
    CHECK(p.file.robots().size() == 2);
    CHECK(p.commands.size() == 4);
    // The .params belongs to NAME.movements.gz too.
    folder.write("scen.params", "J=3D\n");
    const Playback q(folder.write("scen.movements.gz", zipped("0 0 1 1 5 2 2 5 9 3 3 9\n")));
    CHECK(near(q.position("n0", 9), {3, 3, 9}));
}

TEST_CASE("bonnmotion: a damaged or incomplete gzip file is an input error") {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 20'000; ++i)
        text += std::to_string(i) + " " + std::to_string(i * 7 % 991) + " 5 ";
    const std::string bytes = zipped(text);
    REQUIRE(bytes.size() > 1'000);
    for (const std::size_t n : {bytes.size() / 2, bytes.size() - 4, std::size_t{30}}) {
        CHECK(movement_error(folder.write("cut.gz", bytes.substr(0, n)))
                  .starts_with("cut.gz: cannot read the file: "));
    }
    std::string damaged = bytes;
    damaged[bytes.size() - 5] = static_cast<char>(damaged[bytes.size() - 5] ^ 1);
    CHECK(movement_error(folder.write("bad.gz", damaged))
              .starts_with("bad.gz: cannot read the file: "));
}

TEST_CASE(
    "bonnmotion: comments, CR LF, blanks, repeated positions and final empty lines are accepted") {
    const auto p =
        played("# a comment\n#\n \t0 1 1\t 2  3 1 2 3 1 4 3 5 \r\n# 9 9 9\n0 2 2\r\n\r\n\n");
    REQUIRE(p.file.robots().size() == 2);
    CHECK(p.commands.size() == 2);
    CHECK(near(p.position("n0", 1), {2, 1, 0}));
    CHECK(near(p.position("n0", 3), {3, 3, 0}));
    CHECK(p.file.robots()[1].start == Vec3{2, 2, 0});
    CHECK(played("0 1 1 1 2 2").commands.size() == 1);  // no end of line
    const auto still = played("0 1 1\n0 2 2\n");
    CHECK(still.file.notices().empty());
}

TEST_CASE("bonnmotion: an invalid list of waypoints is refused, with line and column") {
    CHECK(error_of("0 1 1 2 x 1\n") == "scen.movements:1:9: found \"x\", expected a number");
    CHECK(error_of("0 1 1\n0 2 nan\n") == "scen.movements:2:5: found \"nan\", expected a number");
    CHECK(error_of("0 1 1\n\n0 2 2\n") ==
          "scen.movements:2:1: found an empty line before the last node, expected a line with the "
          "waypoints of a node");
    CHECK(error_of("0 1 1 2 1 2 1\n") ==
          "scen.movements:1:14: found a line of 7 numbers, expected \"time x y z\" once or more, "
          "so a multiple of 4 numbers, or of 3 numbers");
    CHECK(error_of("0 1 1 5 1 1 4 2 1\n") ==
          "scen.movements:1:13: found \"4\", expected a later time than the time of the previous "
          "waypoint");
    CHECK(error_of("0 1 1 5 1 1 5 2 1\n") ==
          "scen.movements:1:13: found a different place at the time of the previous waypoint, "
          "expected a "
          "time at least 1 ns later");
    CHECK(error_of("-1 1 1\n") ==
          "scen.movements:1:1: found \"-1\", expected a time from 0 to 9e9 "
          "[s]");
    CHECK(error_of("9e9 1 1\n") == "");
    CHECK(error_of("9.1e9 1 1\n").starts_with("scen.movements:1:1: "));
    CHECK(error_of("0 1 1.1e9\n").starts_with("scen.movements:1:5: "));
    CHECK(error_of("0 1 1 " + std::string(500, '1')).starts_with("scen.movements:1:7: found "));
    CHECK(error_of(std::string("0 1 1\0", 6)).starts_with("scen.movements:1:6: found \"?\""));
}

TEST_CASE("bonnmotion: lines may be longer than the blocks in which the file is read") {
    std::string text;
    for (int node = 0; node < 3; ++node) {
        for (int i = 0; i < 40'000; ++i) {
            text += std::to_string(i) + " " + std::to_string(i + node) + ".25 -" +
                    std::to_string(i % 13) + ".5 ";
        }
        text += '\n';
    }
    REQUIRE(text.size() > 2'000'000);
    const auto p = played(text);
    CHECK(p.commands.size() == 3 * 39'999);
    int wrong = 0;
    for (std::size_t i = 0; i < p.commands.size(); ++i) {
        const auto& c = p.commands[i];
        const auto k = static_cast<int>(i / 3) + 1;
        wrong += c.robot != i % 3 || c.to != Vec3{k + 0.25 + c.robot, -(k % 13) - 0.5, 0};
    }
    CHECK(wrong == 0);
    CHECK(error_of(text.substr(0, text.size() - 1) + " x").starts_with("scen.movements:3:"));
}

TEST_CASE("bonnmotion: a damaged file is read or refused, without a crash") {
    std::mt19937 draw(5);
    const auto below = [&](std::size_t n) { return draw() % n; };
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string text = two_nodes;
        for (std::size_t n = 1 + below(3); n > 0; --n) {
            const std::size_t at = below(text.size());
            switch (below(3)) {
                case 0: text[at] = static_cast<char>(below(256)); break;
                case 1: text.erase(at, 1 + below(10)); break;
                default: text[at] = "0123456789 .-\n"[below(14)]; break;
            }
        }
        refused += error_of(text) != "";
    }
    CHECK(refused > 100);
    CHECK(refused < 400);
}

TEST_CASE("bonnmotion: an endless line is refused, compressed or not") {
    const TemporaryFolder folder;
    std::string zeros(20U << 20, ' ');
    for (std::size_t i = 0; i < zeros.size(); i += 2) zeros[i] = '0';
    const std::string words =
        "a line is longer than 16777216 bytes, which is the limit; check that this is the right "
        "file";
    for (const std::string& bytes : {zeros, zipped(zeros)}) {
        const std::string error = movement_error(folder.write("scen.movements", bytes));
        CAPTURE(error);
        CHECK(error.find(words) != std::string::npos);
    }
    const std::string comment = "#" + zeros + "\n0 1 2\n";
    CHECK(movement_error(folder.write("scen.movements", comment)).find(words) != std::string::npos);
}

TEST_CASE(
    "bonnmotion: a file with one line per time, not per node, is refused; a file of resting nodes "
    "is read") {
    for (const char* track : {"0 0.5 1.5\n1 1.5 1.5\n2 2.5 1.5\n", "0.0 1 2 0\n0.1 1 3 0\n",
                              "0 1 1\n0 5 5\n1 1 2\n1 5 6\n", "3 1 1\n4 1 1\n"}) {
        CAPTURE(track);
        CHECK(error_of(track).find("this is a track") != std::string::npos);
        CHECK(error_of(track, "J=2D\n").find("this is a track") == std::string::npos);
    }
    for (const char* standing : {"0 1 1\n0 5 5\n", "2 1 1\n2 5 5\n", "0 0.5 1.5\n",
                                 "2 1 1\n1 2 2\n", "0 1 1 1 2 2\n2 3 3\n"}) {
        CAPTURE(standing);
        CHECK(error_of(standing).empty());
    }
}

}  // namespace bonnmotion_test
