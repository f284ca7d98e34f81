// SPDX-License-Identifier: MIT
// where, and links --history: places of robots and of the gaps in their links.
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace where_test {
using namespace rovernet::test;

namespace {

/// B drives away from A at 1 m/s; they hear each other within 60 m.
const std::string pair = R"([scenario]
duration = "100 s"
[propagation]
model = "disc"
range = "60 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["10 m", "0 m"]
move = { model = "goal", to = ["110 m", "0 m"], speed = "1 m/s" }
)";

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE(
    "links --history --places: each link change is printed with the positions of both robots") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const std::vector<std::string> asked = {
        "links", folder.path("pair.toml"), "--history", "--places", "--robot", "A"};
    const auto lines = lines_of(command(folder, asked).out);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0] == "time_s,from,to,event,from_x_m,from_y_m,from_z_m,to_x_m,to_y_m,to_z_m");
    CHECK(lines[2] ==
          "50.000000001,B,A,down,60.000000,0.000000,0.000000,0.000000,0.000000,0.000000");
    const Json changes = json_of(folder, asked)["changes"];
    REQUIRE(changes.size() == 2);
    CHECK(changes[1]["event"] == "down");
    CHECK(near(changes[1]["from_x_m"], 60, 1e-6));
    CHECK(changes[1]["to"] == "A");
    CHECK(command(folder, {"links", folder.path("pair.toml"), "--places"}).exit == 2);
    CHECK(command(folder, {"links", folder.path("pair.toml"), "--history", "--at", "1s"}).exit ==
          2);
}

TEST_CASE("where: in a list of robots, a name that contains a comma is written in quotes") {
    const TemporaryFolder folder;
    std::string renamed = pair;
    renamed.replace(renamed.find("\"A\""), 3, "\"desk, no 1\"");
    folder.write("pair.toml", renamed + "[[robot]]\nname = \"C\"\nat = [\"200 m\", \"0 m\"]\n");
    const auto gaps = [&](const std::string& to) {
        return json_of(folder, {"where", folder.path("pair.toml"), "--robot", "B", "--to", to});
    };
    CHECK(gaps("\"desk, no 1\"")["to"] == Json::array({"desk, no 1"}));
    CHECK(gaps("C,\"desk, no 1\"")["to"] == Json::array({"C", "desk, no 1"}));
    CHECK(gaps("\"C\"")["to"] == Json::array({"C"}));
}

TEST_CASE("where: the gaps of a robot (times without a link) are printed as text, CSV and JSON") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    std::vector<std::string> asked = {"where", folder.path("pair.toml"), "--robot", "B", "--to",
                                      "A"};
    const auto lines = lines_of(command(folder, asked).out);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0] ==
          "B has no link to A for 50.000 s of 100 s (50.0 %), and on 50.00 m of the 100.00 m of "
          "its path");
    CHECK(lines[2] == "50.000     100.000  50.000     50.00     (60.00, 0.00)  (110.00, 0.00)");
    const Json gaps = json_of(folder, asked);
    CHECK(near(gaps["lost_share"], 0.5, 1e-9));
    REQUIRE(gaps["gaps"].size() == 1);
    CHECK(near(gaps["gaps"][0]["end_x_m"], 110, 1e-9));
    asked.push_back("--csv");
    const auto csv = lines_of(command(folder, asked).out);
    REQUIRE(csv.size() == 2);
    CHECK(csv[1] ==
          "50.000000001,100.000000000,50.000000,60.000000,0.000000,0.000000,110.000000,0.000000,"
          "0.000000");
    const Ended never = command(folder, {"where", folder.path("pair.toml"), "--robot", "B", "--to",
                                         "A", "--set", "propagation.range=110"});
    CHECK(never.out == "B has a link to A all the time (100 s)\n");
}

TEST_CASE(
    "where: --robot prints the path of a robot; a call with neither --robot nor --at is refused") {
    const TemporaryFolder folder;
    folder.write("pair.toml", pair);
    const Json times =
        json_of(folder, {"where", folder.path("pair.toml"), "--robot", "B"})["times"];
    REQUIRE(times.size() == 2);  // it sets off at once, and arrives as the run ends
    REQUIRE(times[1]["robots"].size() == 1);
    CHECK(near(times[1]["robots"][0]["x_m"], 110, 1e-9));
    const Ended nothing = command(folder, {"where", folder.path("pair.toml")});
    CHECK(nothing.exit == 2);
    CHECK(nothing.err.find("expected --at 10s,20s") != std::string::npos);
    CHECK(command(folder, {"where", folder.path("pair.toml"), "--to", "A"}).exit == 2);
    CHECK(command(folder, {"where", folder.path("pair.toml"), "--robot", "C"}).exit == 2);
}

TEST_CASE("where: the duration of one round is printed after the path of a patrolling robot") {
    const TemporaryFolder folder;
    const std::string path = folder.write("patrol.toml", R"([scenario]
duration = "100 s"
[[robot]]
name = "A"
at = ["0 m", "5 m"]
turn_rate = "90 deg/s"
move = { model = "patrol", path = [["0 m", "0 m"], ["10 m", "0 m"], ["0 m", "0 m"], ["0 m", "5 m"]], speed = "2 m/s" }
)");
    // 30 m at 2 m/s. The robot turns by 90, 180, 90 and 180 degrees; at the start by 90 degrees.
    const std::vector<std::string> asked = {"where", path, "--robot", "A"};
    CHECK(command(folder, asked)
              .out.ends_with("a round of the patrol, through all 4 places, takes 21.000000 s (the "
                             "last round begins "
                             "at 62.000000 s)\n"));
    CHECK(near(json_of(folder, asked)["round_s"], 21, 1e-9));
    const auto with = [&](const std::string& setting) {
        std::vector<std::string> words = asked;
        words.insert(words.end(), {"--set", setting});
        return command(folder, words).out;
    };
    // From elsewhere a round begins at the first place, here after a turn by 90 degrees and 6 m.
    const std::string place = "robot.A.at=[\"0 m\", \"-6 m\"]";
    CHECK(with(place).ends_with("takes 21.000000 s (the last round begins at 67.000000 s)\n"));
    CHECK(with("scenario.duration=\"20 s\"")
              .ends_with("takes 20.000000 s (the last round begins at 0.000000 s)\n"));
    CHECK(with("scenario.duration=\"19.9 s\"").find("round") == std::string::npos);
    CHECK(command(folder, {"where", path, "--at", "9s"}).out.find("round") == std::string::npos);
}

}  // namespace where_test
