// SPDX-License-Identifier: MIT
#include "mobility/files/setdest.hpp"

#include "test/mobility/files/playback.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace setdest_test {
using namespace rovernet;
using test::movement_error;
using test::Playback;
using test::TemporaryFolder;

namespace {

/// A few roundings of coordinates up to 1 km, and times rounded to nanoseconds at up to 20 m/s.
constexpr double tolerance = 3e-8;  // [m] or [m/s]

bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

Playback played(const std::string& text, MovementSyntax syntax = MovementSyntax::strict) {
    const TemporaryFolder folder;
    return Playback(folder.write("scen.tcl", text), syntax);
}
std::string error_of(const std::string& text, MovementSyntax syntax = MovementSyntax::strict) {
    const TemporaryFolder folder;
    return movement_error(folder.write("scen.tcl", text), syntax);
}

const std::string place_0 =
    "$node_(0) set X_ 1.0\n"
    "$node_(0) set Y_ 2.0\n"
    "$node_(0) set Z_ 3.0\n";

}  // namespace

// The first sixteen cases are those of ns-3's mobility-ns2-trace-helper test, with lines of our
// own.

TEST_CASE("setdest: positions that are set without a time are start positions") {
    const auto p = played(place_0);
    REQUIRE(p.file.robots().size() == 1);
    CHECK(p.file.robots()[0].name == "n0");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 3});
    CHECK(p.file.robots()[0].appears == start_of_run);
    CHECK(p.commands.empty());
    CHECK(p.file.notices().empty());
    CHECK(p.position("n0", 100) == Vec3{1, 2, 3});
}

TEST_CASE("setdest: comments are accepted everywhere") {
    const auto p = played(
        "# $node_(0) set X_ 9\n"
        "   # blanks before\n"
        "#\n"
        "\n"
        "$node_(0) set X_ 1.0 # here\n"
        "$node_(0) set Y_ 2.0# and here\n"
        "$ns_ at 1.0 \"$node_(0) setdest 5.0 2.0 1.0\"; # SUMO-ID: 7\n"
        "# $ns_ at 2.0 \"$node_(0) setdest 9 9 9\"\n");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 0});
    CHECK(p.commands.size() == 1);
    CHECK(near(p.position("n0", 3), {3, 2, 0}));
}

TEST_CASE(
    "setdest: a setdest command starts at its time, moves at its speed, and ends at its target") {
    const auto p = played("$ns_ at 1.0 \"$node_(0) setdest 25 0 5\"\n");
    CHECK(near(p.velocity("n0", 0.999), {}));
    CHECK(near(p.position("n0", 1), {}));
    CHECK(near(p.velocity("n0", 1), {5, 0, 0}));
    CHECK(near(p.position("n0", 3), {10, 0, 0}));
    CHECK(near(p.position("n0", 6), {25, 0, 0}));
    CHECK(near(p.velocity("n0", 6), {}));
    CHECK(p.file.end() == start_of_run + from_seconds(6));
}

TEST_CASE("setdest: four motions in a row lead a node around a square") {
    const auto p = played(
        "$node_(0) set X_ 0.0\n$node_(0) set Y_ 0.0\n"
        "$ns_ at 1.0 \"$node_(0) setdest 5 0 5\"\n"
        "$ns_ at 2.0 \"$node_(0) setdest 5 5 5\"\n"
        "$ns_ at 3.0 \"$node_(0) setdest 0 5 5\"\n"
        "$ns_ at 4.0 \"$node_(0) setdest 0 0 5\"\n");
    CHECK(near(p.velocity("n0", 1), {5, 0, 0}));
    CHECK(near(p.position("n0", 2), {5, 0, 0}));
    CHECK(near(p.velocity("n0", 2), {0, 5, 0}));
    CHECK(near(p.position("n0", 3), {5, 5, 0}));
    CHECK(near(p.velocity("n0", 3), {-5, 0, 0}));
    CHECK(near(p.position("n0", 4), {0, 5, 0}));
    CHECK(near(p.velocity("n0", 4), {0, -5, 0}));
    CHECK(near(p.position("n0", 5), {}));
    CHECK(near(p.velocity("n0", 5), {}));
}

TEST_CASE("setdest: start positions may stand after the motions in the file, and cause no notice") {
    const std::string moves =
        "$ns_ at 1.0 \"$node_(0) setdest 10 2 1\"\n"
        "$ns_ at 2.0 \"$node_(1) setdest 1 1 1\"\n";
    const std::string places = place_0 + "$node_(1) set X_ 1\n$node_(1) set Y_ -1\n";
    const auto p = played(moves + places);
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 3});
    CHECK(near(p.position("n0", 2), {2, 2, 3}));
    CHECK(near(p.position("n1", 3), {1, 0, 0}));
    CHECK(p.file.end() == start_of_run + from_seconds(10));
    CHECK(p.file.notices().empty());
    CHECK(played(places + moves).file.end() == p.file.end());
}

TEST_CASE("setdest: setting X_, Y_ or Z_ at a given time makes the robot jump in this coordinate") {
    const auto p = played(
        "$ns_ at 1.0 \"$node_(0) set X_ 10\"\n"
        "$ns_ at 2.0 \"$node_(0) set Y_ 20\"\n"
        "$ns_ at 3.0 \"$node_(0) set Z_ 30\"\n"
        "$ns_ at 4.0 \"$node_(0) setdest 20 20 2\"\n"
        "$ns_ at 6.0 \"$node_(0) set Y_ 50\"\n");
    CHECK(p.position("n0", 0.5) == Vec3{});
    CHECK(p.position("n0", 1) == Vec3{10, 0, 0});
    CHECK(p.position("n0", 2) == Vec3{10, 20, 0});
    CHECK(p.position("n0", 3) == Vec3{10, 20, 30});
    CHECK(near(p.position("n0", 5), {12, 20, 30}));
    CHECK(near(p.position("n0", 6), {14, 50, 30}));
    CHECK(near(p.position("n0", 9), {14, 50, 30}));  // it has ended the motion
    CHECK(p.file.end() == start_of_run + from_seconds(6));
}

TEST_CASE("setdest: an invalid line is refused with its line number, or in tolerant mode skipped") {
    const std::vector<std::pair<std::string, std::string>> lines = {
        {"$node_() set X_ 1",
         "1: found \"$node_()\", expected a node as in $node_(0), its number "
         "below 10000000"},
        {"$node_ set X_ 2",
         "1: found \"$node_\", expected a node as in $node_(0): names without brackets are not "
         "read"},
        {"$node set Y 2",
         "1: found \"$node\", expected $node_(0) set ..., $ns_ at ..., $god_ ... "
         "or a comment (#); did you mean \"$node_(0)\"?"},
        {"$node_(0 set X_ 3",
         "1: found \"$node_(0\", expected a node as in $node_(0), its number "
         "below 10000000"},
        {"$node_(-2) set X_ 4", "1: found \"$node_(-2)\", expected a node"},
        {"$node_(1.5) set X_ 4", "1: found \"$node_(1.5)\", expected a node"},
        {"$node_(10000000) set X_ 4", "1: found \"$node_(10000000)\", expected a node"},
        {"$node_(0) setX_ 5", "11: found \"setX_\", expected set; did you mean \"set\"?"},
        {"$node_(0) set Q_ 5", "15: found \"Q_\", expected X_, Y_ or Z_"},
        {"$node_(0) set X_",
         "17: found the end of the line, expected a coordinate from -1e9 to 1e9 [m]"},
        {"$node_(0) set X_ 1 2", "20: found \"2\", expected the end of the command"},
        {"$node_(0) set X_ 1; $node_(0) set Y_ 2", "18: found \"1;\", expected a coordinate"},
        {"$node_(0) setdest 1 2 3", "11: found \"setdest\", expected set; a setdest needs a time"},
        {"$ns_ at \"$node_(0) setdest 3 3 1\"",
         "9: found \"\"$node_(0)\", expected a time from 0 to "
         "9e9 [s]"},
        {"$ns_at 4.0 \"$node_(0) setdest 4 4 1\"",
         "1: found \"$ns_at\", expected $node_(0) set ..."},
        {"$ns_ in 4.0 \"$node_(0) setdest 4 4 1\"", "6: found \"in\", expected at"},
        {"$ns_ at 5.0 \"$node_(0) setdest 5 5\"",
         "35: found the end of the line, expected a speed from 0 to 1e9 "
         "[m/s]"},
        {"$ns_ at 5.0 \"$node_(0) setdst 5 5 5\"",
         "24: found \"setdst\", expected setdest or set; did "
         "you mean \"setdest\"?"},
        {"$ns_ at 5.0 $node_(0) setdest 5 5 5",
         "13: found \"$node_(0)\", expected a command in "
         "quotes (\")"},
        {"$ns_ at 5.0 \"$node_(0) setdest 5 5 5",
         "37: found the end of the line, expected a closing quote (\")"},
        {"$ns_ at 5.0 \"", "14: found the end of the line, expected a closing quote (\")"},
        {"$ns_ at 5.0 \"\"", "14: found the end of the line, expected a node"},
        {"$ns_ at 5.0 \"$node_(0) setdest 5 5 5 5\"",
         "38: found \"5\", expected the end of the "
         "command"},
        {"set opt(nn) 20", "1: found \"set\", expected $node_(0) set ..."},
        {std::string("$node_(\0) set X_ 1", 18), "1: found \"$node_(?)\", expected a node"},
    };
    for (const auto& line : lines) {
        CAPTURE(line.first);
        const std::string text = place_0 + line.first + "\n$ns_ at 9 \"$node_(0) setdest 9 2 1\"\n";
        const std::string error = error_of(text);
        CHECK(error.substr(0, 11 + line.second.size()) == "scen.tcl:4:" + line.second);
        const auto p = played(text, MovementSyntax::tolerant);
        CHECK(p.file.robots().size() == 1);
        CHECK(p.commands.size() == 1);
        REQUIRE(p.file.notices().size() == 1);
        CHECK(p.file.notices()[0].starts_with("1 line is left out; the first"));
        CHECK(p.file.notices()[0].ends_with(error));
    }
}

TEST_CASE("setdest: for a node named $n0, the error shows the expected form $node_(0)") {
    const std::string course_script =
        "set ns [new Simulator]\n"
        "$ns node-config -adhocRouting AODV\n"
        "$n0 set X_ 100.0\n"
        "$n12 set X_ 200.0\n"
        "$ns at 1.0 \"$n0 setdest 300.0 100.0 25.0\"\n";
    const std::string expected =
        "scen.tcl:3:1: found \"$n0\", expected a node as in $node_(0): names without brackets are "
        "not read";
    CHECK(error_of(course_script, MovementSyntax::tolerant) == expected);
    CHECK(error_of("$n12 set X_ 1\n") ==
          "scen.tcl:1:1: found \"$n12\", expected a node as in $node_(12): names without brackets "
          "are not read");
    CHECK(error_of("$ns at 1.0 \"$n0 setdest 300.0 100.0 25.0\"\n")
              .starts_with("scen.tcl:1:13: found \"$n0\", expected a node as in $node_(0): "));
    CHECK(error_of("$udp0 set class_ 1\n").find("brackets") == std::string::npos);
    const auto some = played(course_script + place_0, MovementSyntax::tolerant);
    CHECK(some.file.robots().size() == 1);
    REQUIRE(some.file.notices().size() == 1);
    CHECK(
        some.file.notices()[0].starts_with("5 lines are left out; the first that moves a robot: "));
    CHECK(some.file.notices()[0].ends_with(expected));
}

TEST_CASE("setdest: impossible values are refused, or in tolerant mode skipped with one notice") {
    const std::vector<std::string> lines = {
        "$node_(0) set X_ NaN",
        "$node_(0) set X_ inf",
        "$node_(0) set X_ 1e400",
        "$node_(0) set X_ 1.0000001e9",
        "$node_(0) set X_ 0x10",
        "$node_(0) set X_ +-1",
        "$node_(0) set X_ 1,5",
        "$ns_ at NaN \"$node_(0) setdest 3 3 3\"",
        "$ns_ at -1 \"$node_(0) setdest 3 3 3\"",
        "$ns_ at 9.1e9 \"$node_(0) setdest 3 3 3\"",
        "$ns_ at 1 \"$node_(0) setdest NaN 3 3\"",
        "$ns_ at 1 \"$node_(0) setdest 3 -inf 3\"",
        "$ns_ at 1 \"$node_(0) setdest 3 3 -3\"",
        "$ns_ at 1 \"$node_(0) setdest 3 3 NaN\"",
    };
    std::string all = place_0;
    for (const auto& line : lines) {
        CAPTURE(line);
        CHECK(error_of(place_0 + line + "\n").starts_with("scen.tcl:4:"));
        all += line + '\n';
    }
    const auto p = played(all, MovementSyntax::tolerant);
    CHECK(p.commands.empty());
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 3});
    REQUIRE(p.file.notices().size() == 1);
    CHECK(p.file.notices()[0].starts_with("14 lines are left out; the first: "));
}

TEST_CASE(
    "setdest: robots have the node numbers of the file; unused numbers do not become robots") {
    const auto p = played(
        "$ns_ at 1 \"$node_(7) setdest 8 0 1\"\n"
        "$node_(3) set X_ 3\n"
        "$n(12) set X_ 12\n"
        "$node_(7) set X_ 7\n");
    REQUIRE(p.file.robots().size() == 3);
    CHECK(p.file.robots()[0].name == "n3");
    CHECK(p.file.robots()[1].name == "n7");
    CHECK(p.file.robots()[2].name == "n12");
    CHECK(near(p.position("n7", 1.5), {7.5, 0, 0}));
    CHECK(p.position("n12", 5) == Vec3{12, 0, 0});
}

TEST_CASE("setdest: speed 0 stops a robot where it is") {
    const auto p = played(
        "$ns_ at 1.0 \"$node_(0) setdest 10 0 2\"\n"
        "$ns_ at 3.0 \"$node_(0) setdest 10 0 0\"\n"
        "$ns_ at 5.0 \"$node_(0) setdest 10 0 3.0\"\n");
    CHECK(near(p.position("n0", 3), {4, 0, 0}));
    CHECK(near(p.velocity("n0", 3), {}));
    CHECK(near(p.position("n0", 5), {4, 0, 0}));
    CHECK(near(p.position("n0", 6), {7, 0, 0}));
    CHECK(near(p.position("n0", 7), {10, 0, 0}));
}

TEST_CASE("setdest: coordinates may be negative") {
    const auto p = played(
        "$node_(0) set X_ -1\n$node_(0) set Y_ -.5\n"
        "$ns_ at 0 \"$node_(0) setdest -5 -0.5 4\"\n");
    CHECK(p.file.robots()[0].start == Vec3{-1, -0.5, 0});
    CHECK(near(p.velocity("n0", 0), {-4, 0, 0}));
    CHECK(near(p.position("n0", 2), {-5, -0.5, 0}));
}

TEST_CASE("setdest: numbers in the notation of C and Tcl are accepted") {
    const auto p = played(
        "$node_(0) set X_ 1.0e+2\n$node_(0) set Y_ +1E1\n$node_(0) set Z_ 5.\n"
        "$ns_ at 1e0 \"$node_(0) setdest 1.1e+2 1.0e+1 1e+0\"\n");
    CHECK(p.file.robots()[0].start == Vec3{100, 10, 5});
    CHECK(near(p.position("n0", 6), {105, 10, 5}));
}

TEST_CASE(
    "setdest: a motion to a new target starts at the robot's current position (ns-3 bug 1219)") {
    const auto p = played(
        "$ns_ at 1 \"$node_(0) setdest 0 10 1\"\n"
        "$ns_ at 6 \"$node_(0) setdest 0 -10 1\"\n");
    CHECK(near(p.velocity("n0", 1), {0, 1, 0}));
    CHECK(near(p.position("n0", 6), {0, 5, 0}));
    CHECK(near(p.velocity("n0", 6), {0, -1, 0}));
    CHECK(near(p.position("n0", 16), {0, -5, 0}));
    CHECK(near(p.position("n0", 21), {0, -10, 0}));
    CHECK(near(p.velocity("n0", 21), {}));
}

TEST_CASE("setdest: lines may end with CR LF (ns-3 bug 1059), blanks and semicolons") {
    const auto p = played(
        "$node_(0) set X_ 1.0 \r\n"
        "\t$node_(0)\tset  Y_   2.0 ;\t\r\n"
        "$node_(0) set Z_ 3.0;;\r\n"
        "\r\n"
        "$ns_ at 1.0 \"$node_(0) setdest 5.0 2.0 1.0\" ; \r\n"
        "$ns_ at 5.0 \"$node_(0) setdest 1.0 2.0 1.0 \"\r\n"
        "$ns at 9.0 \" $node_(0) setdest 1.0 9.0 1.0\"");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 3});
    CHECK(near(p.position("n0", 5), {5, 2, 3}));
    CHECK(near(p.position("n0", 9), {1, 2, 3}));
    CHECK(near(p.position("n0", 10), {1, 3, 3}));
}

TEST_CASE("setdest: a target at the current position causes no motion (ns-3 bug 1301)") {
    const auto p = played(place_0 +
                          "$ns_ at 1.0 \"$node_(0) setdest 1.0 2.0 5.0\"\n"
                          "$ns_ at 2.0 \"$node_(0) setdest 1.0 2.0 0.0\"\n"
                          "$ns_ at 3.0 \"$node_(0) setdest 1.0 4.0 1.0\"\n");
    for (const double t : {1.0, 1.5, 2.0, 3.0}) CHECK(p.position("n0", t) == Vec3{1, 2, 3});
    CHECK(near(p.position("n0", 5), {1, 4, 3}));
    CHECK(p.file.end() == start_of_run + from_seconds(5));
}

TEST_CASE("setdest: six motions, some cut short, give the calculated positions (ns-3 bug 1316)") {
    const auto p = played(
        "$node_(0) set X_ 200\n$node_(0) set Y_ 100\n$node_(0) set Z_ 7\n"
        "$ns_ at 20 \"$node_(0) setdest 500 100 2\"\n"
        "$ns_ at 170 \"$node_(0) setdest 500 900 2\"\n"   // interrupted at (500, 400)
        "$ns_ at 320 \"$node_(0) setdest 1250 400 3\"\n"  // interrupted at (950, 400)
        "$ns_ at 470 \"$node_(0) setdest 950 700 2\"\n"
        "$ns_ at 620 \"$node_(0) setdest 300 1250 10\"\n"  // 851 m, then a rest
        "$ns_ at 770 \"$node_(0) setdest 300 650 4\"\n");
    CHECK(near(p.position("n0", 20), {200, 100, 7}));
    CHECK(near(p.position("n0", 170), {500, 100, 7}));
    CHECK(near(p.position("n0", 320), {500, 400, 7}));
    CHECK(near(p.position("n0", 470), {950, 400, 7}));
    CHECK(near(p.position("n0", 620), {950, 700, 7}));
    CHECK(near(p.position("n0", 770), {300, 1250, 7}));
    CHECK(near(p.velocity("n0", 770), {0, -4, 0}));
    CHECK(near(p.position("n0", 920), {300, 650, 7}));
    CHECK(near(p.velocity("n0", 920), {}));
    CHECK(p.file.end() == start_of_run + from_seconds(920));
}

TEST_CASE("setdest: commands to the object `god` of ns-2 are ignored") {
    const auto p = played(place_0 +
                          "$god_ set-dist 0 1 16777215\n"
                          "$ns_ at 3.9 \"$god_ set-dist 0 1 1\"\n");
    CHECK(p.commands.empty());
    CHECK(p.file.end() == start_of_run);
}

TEST_CASE(
    "setdest: lines that are not in order of time cause one notice, and the same motion as sorted "
    "lines") {
    std::mt19937 draw(3);
    const auto below = [&](unsigned n) { return static_cast<double>(draw() % n); };
    std::vector<std::string> lines;
    for (int i = 0; i < 300; ++i) {
        std::ostringstream line;
        const double time = i * 0.25;
        line << "$ns_ at " << time << " \"$node_(" << draw() % 5;
        if (i % 7 == 3) {
            line << ") set "
                 << "XYZ"[draw() % 3] << "_ " << below(500) << "\"\n";
        } else {
            line << ") setdest " << below(500) << ' ' << below(500) << ' ' << below(30) << "\"\n";
        }
        lines.push_back(line.str());
    }
    std::string in_order = place_0;
    for (const auto& line : lines) in_order += line;
    std::shuffle(lines.begin(), lines.end(), draw);
    std::string shuffled;
    for (const auto& line : lines) shuffled += line;
    shuffled += place_0;

    const auto a = played(in_order);
    const auto b = played(shuffled);
    CHECK(a.file.notices().empty());
    REQUIRE(b.file.notices().size() == 1);
    CHECK(b.file.notices()[0].ends_with(
        "scen.tcl is not sorted by time, so 300 legs of the robots' paths are kept in memory"));
    REQUIRE(a.commands.size() == b.commands.size());
    int differences = 0;
    for (std::size_t i = 0; i < a.commands.size(); ++i) {
        const auto& [time, robot, kind, to, speed, arrival] = a.commands[i];
        const auto& other = b.commands[i];
        differences += time != other.time || robot != other.robot || kind != other.kind ||
                       to != other.to || speed != other.speed || arrival != other.arrival;
    }
    CHECK(differences == 0);
    CHECK(a.file.end() == b.file.end());
}

TEST_CASE(
    "setdest: simultaneous commands are executed in file order, also if the file is unsorted") {
    const std::string late = "$ns_ at 9 \"$node_(0) setdest 9 9 9\"\n";
    std::string same;
    for (int i = 0; i < 50; ++i) {
        same += "$ns_ at 2 \"$node_(" + std::to_string(i % 3) + ") setdest " + std::to_string(i) +
                " 0 1\"\n";
    }
    for (const auto& p : {played(same + late), played(late + same)}) {
        REQUIRE(p.commands.size() == 51);
        int misplaced = 0;
        for (int i = 0; i < 50; ++i) misplaced += p.commands[static_cast<std::size_t>(i)].to.x != i;
        CHECK(misplaced == 0);
    }
}

TEST_CASE("setdest: a motion whose target is never reached ends at the largest time, 9e9 s") {
    const auto p = played("$ns_ at 1 \"$node_(0) setdest 1e9 0 1e-300\"\n");
    CHECK(p.file.end() == start_of_run + from_seconds(9e9));
}

TEST_CASE("setdest: the file is read in blocks; a line that lies in two blocks is read correctly") {
    std::string text = place_0;
    for (int i = 0; text.size() < 1'000'000; ++i) {
        text += "$ns_ at " + std::to_string(i) + " \"$node_(0) setdest " + std::to_string(i) +
                ".5 7 0.25\" " + std::string(static_cast<std::size_t>(i % 97), ' ') + "\n";
    }
    const auto p = played(text);
    int wrong = 0;
    for (std::size_t i = 0; i < p.commands.size(); ++i) {
        wrong += p.commands[i].to != Vec3{static_cast<double>(i) + 0.5, 7, 3};
    }
    CHECK(p.commands.size() > 10'000);
    CHECK(wrong == 0);
    CHECK(error_of(place_0 + "#" + std::string(70'000, 'x') + "\n") ==
          "scen.tcl:4:1: a line is longer than 65536 bytes, which is the limit; check that this is "
          "the right file");
    CHECK(error_of(place_0 + "#" + std::string(65'000, 'x') + "\n") == "");
}

TEST_CASE("setdest: a damaged file is read or refused, without a crash") {
    std::mt19937 draw(5);
    const auto below = [&](std::size_t n) { return draw() % n; };
    const std::string good = place_0 +
                             "$ns_ at 1.0 \"$node_(0) setdest 5.0 2.0 1.0\"\n"
                             "$ns_ at 0.5 \"$node_(1) set X_ 2.0\"\n";
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string text = good;
        for (std::size_t n = 1 + below(4); n > 0; --n) {
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0: text[at] = static_cast<char>(below(256)); break;
                case 1: text.erase(at, 1 + below(10)); break;
                case 2: text.insert(at, good.substr(below(good.size()), below(60))); break;
                default: text[at] = "0123456789 .-_()\"#$e"[below(20)]; break;
            }
        }
        refused += error_of(text) != "";
        error_of(text, MovementSyntax::tolerant);
    }
    CHECK(refused > 100);
    CHECK(refused < 400);
}

TEST_CASE(
    "setdest: robots of a scenario written by CMU's setdest stay inside the scenario's area") {
    const char* folder = std::getenv("ROVERNET_MOVEMENTS");
    if (!folder) {
        MESSAGE("ROVERNET_MOVEMENTS is not set: skipped");
        return;
    }
    const Playback p(std::string(folder) + "/scen-50-1500x300-v20-p0-s1.tcl");
    CHECK(p.file.robots().size() == 50);
    CHECK(p.file.notices().empty());
    CHECK(p.commands.size() == 137);
    int outside = 0;
    for (const auto& robot : p.file.robots()) {
        for (int t = 0; t <= 100; t += 5) {
            const Vec3 at = p.position(robot.name, t);
            outside += !(at.x >= 0 && at.x <= 1500 && at.y >= 0 && at.y <= 300 && at.z == 0);
        }
    }
    CHECK(outside == 0);
}

}  // namespace setdest_test
