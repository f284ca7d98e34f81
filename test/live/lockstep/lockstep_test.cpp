// SPDX-License-Identifier: MIT
// The lock-step protocol, line by line, without sockets.
#include "live/lockstep/lockstep.hpp"

#include "scenario/scenario_file.hpp"
#include "test/live/talk.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace lockstep_test {
using namespace rovernet;
using namespace rovernet::test;
using Json = nlohmann::json;

namespace {

const std::string hello_a = R"({"type":"hello","protocol":1,"robots":["A"],"step":"100 ms"})";
const std::string hello_b = R"({"type":"hello","protocol":1,"robots":["B","C"],"step":"300 ms"})";

std::string step(int n, const std::string& more = {}) {
    return R"({"type":"step","n":)" + std::to_string(n) + more + "}";
}
std::string drive(int n, const std::string& robot, double v) {
    return step(n, R"(,"do":{")" + robot + R"(":{"v":)" + std::to_string(v) +
                       R"(}},"send":[{"from":")" + robot + R"(","data":"Rg=="}])");
}

/// The parts of an error that programs and people go by.
std::string fault(const std::string& line) {
    const Json error = Json::parse(line);
    if (error.value("type", "") != "error") return line;
    CHECK_FALSE(error.at("msg").get<std::string>().empty());
    return error.at("code").get<std::string>() + " " + error.at("at").get<std::string>();
}

std::string type_of(const std::string& line) { return Json::parse(line).at("type"); }

}  // namespace

TEST_CASE("lockstep: the transcript in the documentation is reproduced byte for byte") {
    Talk talk(three_in_a_row());
    std::ifstream file(ROVERNET_TEST_DATA "/../live/transcript.txt");
    REQUIRE(file);
    std::vector<std::string> expected;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("C ")) {
            talk.say(0, line.substr(2));
            if (talk.lockstep.is_done()) talk.end();
        } else if (line.starts_with("S ")) {
            expected.push_back(line.substr(2));
        }
    }
    REQUIRE(expected.size() > 5);
    auto& told = talk.told[0];
    REQUIRE(told.size() == expected.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
        const Json told_now = Json::parse(told[i]);
        if (told_now.contains("version")) {  // that of the library
            const std::string version = told_now["version"].dump();
            told[i].replace(told[i].find(version), version.size(), "\"0.1.0\"");
        }
        CHECK(told[i] == expected[i]);
    }
}

TEST_CASE(
    "lockstep: the answer to a malformed line has an error code and the faulty key; the line "
    "changes nothing") {
    Talk talk(three_in_a_row());
    const auto check = [&](const std::vector<std::pair<std::string, std::string>>& table) {
        for (const auto& row : table) {
            CAPTURE(row.first);
            CHECK(fault(talk.ask(0, row.first)) == row.second);
        }
    };
    const std::string deep =
        R"({"type":"step","n":1,"do":)" + std::string(40, '[') + std::string(40, ']') + "}";
    check({
        {"", "bad_json "},
        {"hello", "bad_json "},
        {R"({"type":"hello")", "bad_json "},
        {R"({"type":"bye"}{})", "bad_json "},
        {R"({"type":"bye","n":1e999})", "bad_json "},
        {"{\"type\":\"\xff\"}", "bad_utf8 "},
        {deep, "too_deep "},
        {"[]", "bad_type "},
        {"7", "bad_type "},
        {"{}", "missing_key type"},
        {R"({"type":7})", "bad_type type"},
        {R"({"type":"helo"})", "unknown_type type"},
        {R"({"type":"step","n":1})", "hello_first type"},
        {R"({"type":"step","n":1,"do":{"B":{"v":1}}})", "hello_first do.B"},
        {R"({"type":"bye"})", "hello_first type"},
        {R"({"type":"reset"})", "hello_first type"},
        {R"({"type":"hello"})", "missing_key protocol"},
        {R"({"type":"hello","protocol":2,"robots":["A"],"step":"1 s"})", "bad_protocol protocol"},
        {R"({"type":"hello","protocol":1,"step":"1 s"})", "missing_key robots"},
        {R"({"type":"hello","protocol":1,"robots":[],"step":"1 s"})", "out_of_range robots"},
        {R"({"type":"hello","protocol":1,"robots":["A","Z"],"step":"1 s"})",
         "unknown_robot robots[1]"},
        {R"({"type":"hello","protocol":1,"robots":["A","A"],"step":"1 s"})",
         "repeated_robot robots"},
        {R"({"type":"hello","protocol":1,"robots":["A"]})", "missing_key step"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":1})", "bad_type step"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 kg"})", "bad_value step"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 ns"})", "out_of_range step"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s","stp":1})", "unknown_key stp"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s","step":"1 s"})",
         "repeated_key step"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s","observe":["pos"]})",
         "bad_value observe[0]"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s","seed":-1})",
         "out_of_range seed"},
        {R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s","name":""})",
         "out_of_range name"},
    });
    CHECK(type_of(talk.ask(0, hello_a)) == "welcome");
    check({
        {hello_a, "hello_again type"},
        {R"({"type":"step"})", "missing_key n"},
        {R"({"type":"step","n":-1})", "out_of_range n"},
        {R"({"type":"step","n":1,"doo":{}})", "unknown_key doo"},
        {R"({"type":"step","n":1,"do":[]})", "bad_type do"},
        {R"({"type":"step","n":1,"do":{"Z":{"v":1}}})", "unknown_robot do.Z"},
        {R"({"type":"step","n":1,"do":{"B":{"v":1}}})", "not_yours do.B"},
        {R"({"type":"step","n":1,"do":{"A":{"v":"1"}}})", "bad_type do.A.v"},
        {R"({"type":"step","n":1,"do":{"A":{"v":1e6}}})", "out_of_range do.A.v"},
        {R"({"type":"step","n":1,"do":{"A":{"w":-1e6}}})", "out_of_range do.A.w"},
        {R"({"type":"step","n":1,"do":{"A":{"v":1,"stop":true}}})", "bad_value do.A"},
        {R"({"type":"step","n":1,"do":{"A":{"goal":[1]}}})", "bad_value do.A.goal"},
        {R"({"type":"step","n":1,"do":{"A":{"goal":[1,2],"speed":0}}})", "out_of_range do.A.speed"},
        {R"({"type":"step","n":1,"do":{"A":{"speed":1}}})", "missing_key do.A.goal"},
        {R"({"type":"step","n":1,"do":{"A":{"stop":false}}})", "bad_value do.A.stop"},
        {R"({"type":"step","n":1,"do":{"A":{"goal":[1,2,1e10]}}})", "out_of_range do.A.goal[2]"},
        {R"({"type":"step","n":1,"do":{"A":{"heading":1}}})", "missing_key do.A.place"},
        {R"({"type":"step","n":1,"do":{"A":{"place":[1,2,3,4]}}})", "bad_value do.A.place"},
        {R"({"type":"step","n":1,"do":{"A":{"place":[1,2],"heading":"N"}}})",
         "bad_type do.A.heading"},
        {R"({"type":"step","n":1,"do":{"A":{"place":[1,2],"goal":[1,2]}}})", "bad_value do.A"},
        {R"({"type":"step","n":1,"do":{"A":{"v":1,"timeout":"0 s"}}})",
         "out_of_range do.A.timeout"},
        {R"({"type":"step","n":1,"do":{"A":{"v":1},"A":{"v":2}}})", "repeated_robot do"},
        {R"({"type":"step","n":1,"do":{"robots":[7],"v":[1]}})", "out_of_range do.robots[0]"},
        {R"({"type":"step","n":1,"do":{"robots":[0],"v":[1,2]}})", "bad_value do.v"},
        {R"({"type":"step","n":1,"do":{"A":{"data":"Rg=="}}})", "unknown_key do.A.data"},
        {R"({"type":"step","n":1,"do":{"A":{"timeout":5}}})", "bad_type do.A.timeout"},
        {R"({"type":"step","n":1,"do":{"A":{"v":1,"timeout":-1}}})", "bad_type do.A.timeout"},
        {R"({"type":"step","n":1,"do":{"robots":[0],"timeout":"0 s"}})", "out_of_range do.timeout"},
        {R"({"type":"step","n":1,"send":{}})", "bad_type send"},
        {R"({"type":"step","n":1,"send":[{"data":"Rg=="}]})", "missing_key send[0].from"},
        {R"({"type":"step","n":1,"send":[{"from":"B","data":"Rg=="}]})", "not_yours send[0].from"},
        {R"({"type":"step","n":1,"send":[{"from":"A"}]})", "missing_key send[0].data"},
        {R"({"type":"step","n":1,"send":[{"from":"A","data":"Rg"}]})", "bad_base64 send[0].data"},
        {R"({"type":"step","n":1,"send":[{"from":"A","to":"A","data":""}]})",
         "bad_value send[0].to"},
        {R"({"type":"step","n":1,"send":[{"from":"A","port":65536,"data":""}]})",
         "out_of_range send[0].port"},
        {R"({"type":"bye","n":1})", "unknown_key n"},
        {R"({"type":"reset","seed":1.5})", "out_of_range seed"},
    });
    const std::string number =
        talk.ask(0, R"({"type":"step","n":1,"do":{"A":{"v":1,"timeout":-1}}})");
    CHECK(Json::parse(number).at("msg") ==
          "found -1; expected a time in quotes with its unit, such as \"0.5 s\"");
    CHECK(Json::parse(talk.ask(0, R"({"type":"step","n":5,"x":1})")).at("n") == 5);
    CHECK(talk.session->network().now() == start_of_run);
    CHECK(type_of(talk.ask(0, step(3))) == "state");
    CHECK(fault(talk.ask(0, step(3))) == "old_number n");
}

TEST_CASE(
    "lockstep: the error for an unknown robot lists the known robots; for an unknown key, the "
    "known keys") {
    Talk talk(three_in_a_row());
    talk.say(0, hello_a);
    CHECK(Json::parse(talk.ask(0, step(1, R"(,"do":{"Zoe":{}})"))).at("msg") ==
          "no robot Zoe; the robots are A, B, C");
    const auto message = [&](const std::string& more) {
        return Json::parse(talk.ask(0, step(1, more))).at("msg").get<std::string>();
    };
    CHECK(message(R"(,"do":{"A":{"timeuot":"1 s"}})") ==
          "unknown key \"timeuot\"; did you mean \"timeout\"?");
    CHECK(message(R"(,"do":{"A":{"x":1}})") ==
          "unknown key \"x\"; known keys are v, w, timeout, goal, speed, stop, place, heading");
    CHECK(message(R"(,"do":{"A":{"v":1,"goal":[1,2]}})") ==
          "expected one command only: v, w and timeout, or goal and speed, or stop, or place and "
          "heading");
    CHECK(message(R"(,"do":{"A":{"v":1001}})") ==
          "found 1001; expected a number from -1000 to 1000 m/s");
    CHECK(message(R"(,"do":{"A":{"heading":1}})") ==
          "\"place\" is missing; expected a value such as \"place\":[1,12]");
    CHECK(message(R"(,"send":[{"from":"A"}])") ==
          "\"data\" is missing; expected a value such as \"data\":\"Rg==\"");
    CHECK(message(R"(,"do":{"A":{"stop":false}})") == "expected \"stop\":true");
    CHECK(message(R"(,"send":[{"from":"A","data":"","size":65536}])") ==
          "found 65536; expected a whole number from 0 to 65507");
}

TEST_CASE(
    "lockstep: when all controllers have requested a step, time advances to the earliest end of a "
    "step") {
    Talk talk(three_in_a_row(), {.wait_for = 2});
    CHECK(talk.ask(0, hello_a).empty());
    CHECK(fault(talk.ask(0, step(1))) == "too_early ");
    CHECK(type_of(talk.ask(1, hello_b)) == "welcome");
    CHECK(type_of(talk.told[0].back()) == "welcome");
    CHECK(talk.ask(0, step(1)).empty());
    CHECK(fault(talk.ask(0, step(2))) == "too_early ");
    CHECK(talk.ask(1, step(1)).empty());  // until 300 ms
    CHECK(Json::parse(talk.told[0].back()).at("t_ns") == 100'000'000);
    CHECK(Json::parse(talk.ask(0, step(2))).at("t_ns") == 200'000'000);
    CHECK(Json::parse(talk.ask(0, step(3))).at("t_ns") == 300'000'000);
    CHECK(Json::parse(talk.told[1].back()).at("t_ns") == 300'000'000);
}

TEST_CASE(
    "lockstep: results do not depend on the order in which requests arrive or controllers "
    "connect") {
    const auto run = [](bool swapped) {
        Talk talk(three_in_a_row(), {.wait_for = 2});
        const Lockstep::Connection a = 0, b = 1;
        const auto both = [&](const std::string& of_a, const std::string& of_b) {
            talk.lockstep.received(swapped ? b : a, swapped ? of_b : of_a);
            talk.lockstep.received(swapped ? a : b, swapped ? of_a : of_b);
            talk.go_on();
        };
        both(hello_a, R"({"type":"hello","protocol":1,"robots":["B","C"],"step":"100 ms"})");
        for (int n = 1; n <= 20; ++n) {
            both(drive(n, "A", 0.1 * n), drive(n, n % 2 == 0 ? "B" : "C", -0.2 * n));
        }
        CHECK(Json::parse(talk.told[a].back()).at("done") == true);
        return talk.fingerprint->text();
    };
    CHECK(run(false) == run(true));
}

TEST_CASE("lockstep: results do not depend on the order in which controllers leave") {
    const auto run = [](Lockstep::Connection first) {
        Talk talk(three_in_a_row(), {.wait_for = 2});
        talk.say(0, hello_a);
        talk.say(1, hello_b);
        talk.say(first, R"({"type":"bye"})");
        CHECK(talk.told[first].size() == 1);  // as long as the other owes a question
        talk.say(1 - first, R"({"type":"bye"})");
        CHECK(talk.lockstep.is_done());
        talk.end();
        CHECK(type_of(talk.told[first].back()) == "end");
        return talk.fingerprint->text();
    };
    CHECK(run(0) == run(1));
}

TEST_CASE(
    "lockstep: controllers that leave at the same time are removed in the order of their robots") {
    for (const bool is_a_first : {true, false}) {
        CAPTURE(is_a_first);
        Talk talk(three_in_a_row(), {.wait_for = 2});
        talk.say(0, is_a_first ? hello_a : hello_b);
        talk.say(1, is_a_first ? hello_b : hello_a);
        std::vector<NodeId> stopped;
        talk.session->on_input([&](const Input& input) { stopped.push_back(input.robot); });
        talk.say(0, R"({"type":"bye"})");
        talk.say(1, R"({"type":"bye"})");
        std::vector<NodeId> in_order;
        for (const char* name : {"A", "B", "C"}) {
            in_order.push_back(*talk.session->network().find(name));
        }
        CHECK((stopped == in_order));
    }
}

TEST_CASE(
    "lockstep: a robot has one controller; states sent as columns equal states sent as objects") {
    Talk talk(three_in_a_row(), {.wait_for = 1});
    talk.say(0, hello_a);
    CHECK(fault(talk.ask(1, R"({"type":"hello","protocol":1,"robots":["B","A"],"step":"1 s"})")) ==
          "taken robots[1]");
    CHECK(fault(talk.ask(1, R"({"type":"hello","protocol":1,"robots":["B"],"step":"1 s",
        "name":"A"})")) == "taken name");
    CHECK(fault(talk.ask(1, R"({"type":"hello","protocol":1,"robots":["B"],"step":"1 s",
        "seed":9})")) == "other_seed seed");

    Talk lists(three_in_a_row()), objects(three_in_a_row());
    lists.say(0, R"({"type":"hello","protocol":1,"robots":["C","A"],"step":"1 s","columns":true})");
    objects.say(0, R"({"type":"hello","protocol":1,"robots":["C","A"],"step":"1 s"})");
    const Json columns =
        Json::parse(lists.ask(0, step(1, R"(,"do":{"robots":[2,0],"v":[1,2],"w":[0.5,0]})")));
    const Json state =
        Json::parse(objects.ask(0, step(1, R"(,"do":{"C":{"v":1,"w":0.5},"A":{"v":2}})")));
    CHECK(columns.at("state").at("robots") == Json{2, 0});
    for (const char* key : {"x", "y", "heading", "v", "w", "on", "stalled"}) {
        CHECK(columns.at("state").at(key)[0] == state.at("robots").at("C").at(key));
        CHECK(columns.at("state").at(key)[1] == state.at("robots").at("A").at(key));
    }
    CHECK(lists.fingerprint->text() == objects.fingerprint->text());
}

TEST_CASE("lockstep: a robot placed elsewhere rests, with the given heading or its old heading") {
    Talk talk(three_in_a_row());
    talk.say(0, hello_a);
    talk.say(0, step(1, R"(,"do":{"A":{"v":1,"w":0.5}})"));
    const auto state = [&](const std::string& answer) {
        const Json robot = Json::parse(answer).at("robots").at("A");
        return std::tuple(robot.at("x").get<double>(), robot.at("y").get<double>(),
                          robot.value("z", 0.0), robot.at("heading").get<double>(),
                          robot.at("v").get<double>());
    };
    using State = std::tuple<double, double, double, double, double>;
    CHECK(state(talk.ask(0, step(2, R"(,"do":{"A":{"place":[7,-8]}})"))) ==
          State{7, -8, 0, 0.05, 0});
    CHECK(state(talk.ask(0, step(3, R"(,"do":{"A":{"place":[1,2,5],"heading":-1.5}})"))) ==
          State{1, 2, 5, -1.5, 0});
    CHECK(state(talk.ask(0, step(4, R"(,"do":{"A":{"place":[0,0]}})"))) == State{0, 0, 5, -1.5, 0});
}

TEST_CASE(
    "lockstep: a position where the robot does not fit, or a goal off the map, is an error; a goal "
    "without a path is reported") {
    Talk talk(load_scenario(ROVERNET_EXAMPLES "/rescue/rescue.toml", {}));
    talk.say(0, hello_a);
    for (const char* place : {"[-5,3]", "[24,100]", "[2,6]"}) {
        const std::string answer =
            talk.ask(0, step(1, std::string(R"(,"do":{"A":{"place":)") + place + "}}"));
        CHECK(fault(answer) == "no_room do.A.place");
    }
    const std::string off = talk.ask(0, step(1, R"(,"do":{"A":{"goal":[448,12]}})"));
    CHECK(fault(off) == "no_room do.A.goal");
    CHECK(off.find("(448, 12) m is off the map, which goes from (0, 0) to (48, 24) m") != off.npos);
    const auto has_no_way = [](const std::string& answer) {
        return Json::parse(answer).at("robots").at("A").at("no_way").get<bool>();
    };
    CHECK_FALSE(has_no_way(talk.ask(0, step(1, R"(,"do":{"A":{"place":[24,12]}})"))));
    CHECK(has_no_way(talk.ask(0, step(2, R"(,"do":{"A":{"goal":[2,6]}})"))));
    CHECK(has_no_way(talk.ask(0, step(3))));
    for (const char* command :
         {R"({"goal":[25,12]})", R"({"v":0.5})", R"({"stop":true})", R"({"place":[24,12]})"}) {
        CAPTURE(command);
        static int n = 4;
        CHECK_FALSE(
            has_no_way(talk.ask(0, step(n++, std::string(R"(,"do":{"A":)") + command + "}"))));
        CHECK(has_no_way(talk.ask(0, step(n++, R"(,"do":{"A":{"goal":[2,6]}})"))));
    }
}

TEST_CASE(
    "lockstep: scans are sent on request, and the message `welcome` describes the range finders") {
    const std::string hello =
        R"({"type":"hello","protocol":1,"robots":["A","B"],"step":"100 ms","observe":["scan"]})";
    Talk without(three_in_a_row());
    CHECK(fault(without.ask(0, hello)) == "bad_value observe");
    const TemporaryFolder folder;
    Talk talk(load_scenario(folder.write("scan.toml", R"([scenario]
duration = "1 s"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
scan = [{ beams = 3, range = "6 m", at = ["0.1 m", "0 m"] },
        { kind = "sonar", name = "back", angles = ["180 deg"] }]
[[robot]]
name = "B"
at = ["2 m", "0 m"]
)"),
                            {}));
    const Json welcome = Json::parse(talk.ask(0, hello));
    const Json scanners = welcome.at("robots").at("A").at("scan");
    CHECK(scanners.size() == 2);
    CHECK(scanners[0].at("name") == "laser");
    CHECK(scanners[0].at("range") == 6);
    CHECK(scanners[0].at("beams")[1] == Json{0.1, 0.0, 0.0});
    CHECK(scanners[1].at("kind") == "sonar");
    CHECK(welcome.at("robots").at("B").at("scan").empty());
    const Json state = Json::parse(talk.ask(0, step(1)));
    CHECK_FALSE(state.contains("robots"));
    const Json scan = state.at("scan");
    CHECK(scan.at("B").empty());
    CHECK(scan.at("A")[1] == Json{8.0});
    CHECK(scan.at("A")[0].size() == 3);
    // To the body of B, whose radius is 0.2 m.
    CHECK(scan.at("A")[0][1].get<double>() == doctest::Approx(1.7));
    CHECK(scan.at("A")[0][0] == 6);
}

TEST_CASE(
    "lockstep: the message `welcome` has the map's placement, and width and height of its cells") {
    const TemporaryFolder folder;
    folder.write("m.pgm", "P2 4 3 255\n255 255 255 0\n255 255 255 255\n0 255 255 255\n");
    const auto map = [&](const std::string& scene) {
        const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"1.5 m\"]\n";
        Talk talk(load_scenario(folder.write("s.toml", "[scene]\n" + scene + robot), {}));
        return Json::parse(talk.ask(0, hello_a)).at("map");
    };
    const Json picture = map("map = \"m.pgm\"\nsize = [\"8 m\", \"3 m\"]\n");
    CHECK(picture.at("columns") == 4);
    CHECK(picture.at("rows") == 3);
    CHECK(picture.at("cell_size") == Json{2, 1});
    CHECK(picture.at("yaw") == 0);

    folder.write("m.yaml", "image: m.pgm\nresolution: 2\norigin: [-2.5, -2.0, 0.3]\n");
    const Json turned = map("map = \"m.yaml\"\n");
    CHECK(turned.at("cell_size") == Json{2, 2});
    CHECK(turned.at("origin") == Json{-2.5, -2});
    CHECK(turned.at("yaw") == 0.3);
}

TEST_CASE("lockstep: a robot climbs stairs to its goal, and its height is sent") {
    Talk talk(load_scenario(ROVERNET_EXAMPLES "/storeys/storeys.toml", {}));
    const Json welcome = Json::parse(talk.ask(
        0, R"({"type":"hello","protocol":1,"robots":["courier","landing"],"step":"100 ms"})"));
    CHECK(welcome.at("robots").at("courier").at("z") == 0);
    CHECK(welcome.at("robots").at("landing").at("z") == 3);
    CHECK(welcome.at("map").at("floors") ==
          Json::parse(R"([{"height":0,"image":"ground.png"},{"height":3,"image":"upper.png"}])"));
    int n = 0;
    const auto go = [&](const std::string& more) {
        return Json::parse(talk.ask(0, step(++n, more))).at("robots").at("courier");
    };
    const auto is_at = [](const Json& robot, double x, double y) {
        return robot.at("x") == x && robot.at("y") == y;
    };
    Json courier = go(R"(,"do":{"courier":{"goal":[5.5,8.4]}})");
    while (!is_at(courier, 5.5, 8.4)) {
        CHECK(courier.at("z") == 0);
        courier = go("");
    }
    courier = go(R"(,"do":{"courier":{"goal":[9.5,8.4,3]}})");  // 5 m in space, at 1 m/s
    for (int i = 1; i <= 50; ++i, courier = go("")) {
        constexpr double rounding = 1e-9;  // [m]
        CHECK(std::abs(courier.at("z").get<double>() - 3.0 * i / 50) < rounding);
    }
    courier = go(R"(,"do":{"courier":{"goal":[13.2,2]}})");
    while (!is_at(courier, 13.2, 2)) {
        CHECK(courier.at("z") == 3);  // it stays on its storey
        courier = go("");
    }
    CHECK(n < 270);
    CHECK(talk.session->network().position(*talk.session->network().find("courier")) ==
          Vec3{13.2, 2, 3});
}

TEST_CASE(
    "lockstep: in a scenario without storeys, heights are sent only if a robot's height is not 0") {
    Talk objects(three_in_a_row()), lists(three_in_a_row());
    objects.say(0, R"({"type":"hello","protocol":1,"robots":["A","B"],"step":"1 s"})");
    lists.say(0, R"({"type":"hello","protocol":1,"robots":["A","B"],"step":"1 s","columns":true})");
    CHECK(Json::parse(objects.told[0].back()).at("map").is_null());
    const std::string flat = R"(,"do":{"A":{"goal":[1,0]}})";
    CHECK_FALSE(Json::parse(objects.ask(0, step(1, flat))).at("robots").at("A").contains("z"));
    CHECK_FALSE(Json::parse(lists.ask(0, step(1, flat))).at("state").contains("z"));
    const std::string up = R"(,"do":{"A":{"goal":[1,0,1]}})";
    const Json state = Json::parse(objects.ask(0, step(2, up)));
    CHECK(state.at("robots").at("A").at("z") == 1);
    CHECK_FALSE(state.at("robots").at("B").contains("z"));
    CHECK(Json::parse(lists.ask(0, step(2, up))).at("state").at("z") == Json{1, 0});
}

TEST_CASE("lockstep: a run ends at its end time, and restarts by a reset") {
    Talk talk(three_in_a_row());
    talk.say(0, R"({"type":"hello","protocol":1,"robots":["A"],"step":"1.5 s","seed":4})");
    CHECK(Json::parse(talk.told[0].back()).at("seed") == 4);
    talk.say(0, step(1));
    const Json last = Json::parse(talk.ask(0, step(2)));
    CHECK(last.at("done") == true);
    CHECK(last.at("t_ns") == 2'000'000'000);
    const std::string first = talk.fingerprint->text();
    CHECK(fault(talk.ask(0, step(3))) == "done type");
    CHECK(Json::parse(talk.ask(0, R"({"type":"reset"})")).at("t_ns") == 0);
    talk.say(0, step(1));
    talk.say(0, step(2));
    CHECK(talk.fingerprint->text() == first);
    CHECK(Json::parse(talk.ask(0, R"({"type":"reset","seed":5})")).at("seed") == 5);
    talk.say(0, R"({"type":"bye"})");
    CHECK(talk.lockstep.is_done());
    CHECK(talk.lockstep.fault().empty());
    talk.end();
    CHECK(Json::parse(talk.told[0].back()).at("reason") == "bye");
}

TEST_CASE(
    "lockstep: a controller that leaves early gets the message `end`, and the others continue") {
    Talk talk(three_in_a_row(), {.wait_for = 2});
    talk.say(0, hello_a);
    talk.say(1, hello_b);
    talk.say(1, step(1));
    const Json end = Json::parse(talk.ask(0, R"({"type":"bye"})"));
    CHECK(end.at("type") == "end");
    CHECK(end.at("reason") == "bye");
    CHECK(end.at("fingerprint").get<std::string>().size() == 16);
    CHECK(Json::parse(talk.told[1].back()).at("t_ns") == 300'000'000);
}

TEST_CASE(
    "lockstep: if a controller is lost, the run ends, its robots stop, or the run pauses, as "
    "configured") {
    const auto lose = [](Talk& talk) {
        talk.say(0, hello_a);
        talk.say(1, hello_b);
        talk.say(0, drive(1, "A", 1));
        talk.say(1, step(1));
        talk.lockstep.closed(0);
        talk.go_on();
    };
    Talk ends(three_in_a_row(), {.wait_for = 2});
    lose(ends);
    CHECK(ends.lockstep.is_done());
    CHECK(ends.lockstep.fault() ==
          "controller A has disconnected at 0.1 s without a message of type \"bye\"");

    Talk stops(three_in_a_row(), {.wait_for = 2, .on_loss = OnLoss::stop});
    lose(stops);
    CHECK_FALSE(stops.lockstep.is_done());
    CHECK(Json::parse(stops.told[1].back()).at("t_ns") == 300'000'000);
    CHECK(std::abs(stops.session->network().position({0}).x - 0.1) < 1e-9);

    Talk waits(three_in_a_row(), {.wait_for = 2, .on_loss = OnLoss::wait});
    lose(waits);
    CHECK(waits.lockstep.controllers().owing() == std::vector<std::string>{"A"});
    CHECK(type_of(waits.told[1].back()) == "welcome");  // time waits
    const std::string seen = waits.told[0].back();
    CHECK(fault(waits.ask(5, R"({"type":"hello","protocol":1,"robots":["A"],"step":"1 s"})")) ==
          "taken name");
    CHECK(waits.ask(5, hello_a) == seen);  // the same state again, behind a welcome
    CHECK(waits.told[5].size() == 2);
    CHECK(Json::parse(waits.ask(5, step(2))).at("t_ns") == 200'000'000);
    CHECK(Json::parse(waits.ask(5, step(3))).at("t_ns") == 300'000'000);
}

TEST_CASE("lockstep: if a run is stopped during a step, its controllers get the reason `stopped`") {
    Talk talk(three_in_a_row());
    talk.say(0, hello_a);
    talk.lockstep.received(0, step(1));
    talk.session->step(start_of_run + std::chrono::milliseconds(50));
    talk.end();
    CHECK(Json::parse(talk.told[0].back()).at("reason") == "stopped");
}

TEST_CASE(
    "lockstep: input during a step takes effect at the end of the step, in order of arrival") {
    const auto run = [](bool is_ahead) {
        Talk talk(three_in_a_row(), {.on_loss = OnLoss::stop});
        const auto say = [&](Lockstep::Connection from, const std::string& line) {
            is_ahead ? (void)talk.lockstep.received(from, line) : talk.say(from, line);
        };
        talk.say(0, hello_a);
        say(0, drive(1, "A", 1));
        if (is_ahead) talk.session->step(start_of_run + std::chrono::milliseconds(30));
        say(1, hello_b);
        CHECK(talk.told[1].size() == (is_ahead ? 0 : 1));
        say(1, step(1));
        say(0, drive(2, "A", 2));
        say(2, "{}");
        if (is_ahead) talk.lockstep.closed(1);
        if (is_ahead) talk.go_on();
        if (!is_ahead) talk.lockstep.closed(1);
        talk.go_on();
        CHECK(fault(talk.told[2].back()) == "missing_key type");
        CHECK(Json::parse(talk.told[1][0]).at("t_ns") == 100'000'000);
        CHECK(Json::parse(talk.told[0].back()).at("t_ns") == 200'000'000);
        CHECK(std::abs(talk.session->network().position({0}).x - 0.3) < 1e-9);
        return talk.fingerprint->text();
    };
    CHECK(run(true) == run(false));
}

TEST_CASE("lockstep: a first line that is not a JSON object is refused, also during a step") {
    Talk talk(three_in_a_row());
    talk.say(0, hello_a);
    talk.lockstep.received(0, step(1));
    CHECK(talk.lockstep.received(1, "{\"type\"") == 0);
    CHECK(fault(talk.told[1].back()) == "bad_json ");
    CHECK(talk.lockstep.received(1, R"({"type":"hello"})") == 1);
    CHECK(talk.told[1].size() == 1);
    talk.go_on();
    CHECK(fault(talk.told[1].back()) == "missing_key protocol");
}

TEST_CASE(
    "lockstep: a controller cannot register a robot that a client of another protocol drives") {
    Talk talk(three_in_a_row());
    talk.session->attach({NodeId{1}}, "player");
    CHECK(fault(talk.ask(0, R"({"type":"hello","protocol":1,"robots":["A","B"],"step":"1 s"})")) ==
          "taken robots[1]");
}

TEST_CASE(
    "lockstep: a waiting run reports missing controllers, and ends if a controller is slow or has "
    "ended") {
    using namespace std::chrono_literals;
    std::vector<std::string> said;
    Talk talk(three_in_a_row(),
              {.wait_for = 2, .patience = 50ms, .programs = 2, .say = [&](auto text) {
                   said.emplace_back(text);
               }});
    talk.lockstep.held(1h);  // it has not begun
    talk.say(0, hello_a);
    talk.lockstep.held(1h);
    talk.lockstep.held(1h);
    CHECK(said == std::vector<std::string>{"waiting for controllers: 0 of 2 are connected",
                                           "waiting for controllers: 1 of 2 is connected"});
    talk.say(1, hello_b);
    talk.lockstep.held(49ms);
    CHECK_FALSE(talk.lockstep.is_done());
    talk.lockstep.held(50ms);
    CHECK(talk.lockstep.is_done());
    CHECK(talk.lockstep.fault() == "no request within 0.05 s from controller A, B");

    Talk gone(three_in_a_row(), {.programs = 1});
    gone.lockstep.held(0s);
    CHECK_FALSE(gone.lockstep.is_done());
    gone.lockstep.closed(0);
    gone.lockstep.held(0s);
    CHECK(gone.lockstep.fault() ==
          "a controller has ended before it sent a message of type \"hello\"");
}

TEST_CASE("lockstep: if a started program sends no hello within the time limit, the run fails") {
    using namespace std::chrono_literals;
    const auto run_of_three = [](std::optional<std::chrono::nanoseconds> patience) {
        auto talk = std::make_unique<Talk>(three_in_a_row(),
                                           Lockstep::Settings{.wait_for = 3, .patience = patience});
        talk->lockstep.started(0, "python3 a.py");
        talk->lockstep.started(1, "sleep 30");
        talk->say(0, hello_a);
        return talk;
    };
    const auto slow = run_of_three(50ms);
    slow->lockstep.held(49ms);
    CHECK_FALSE(slow->lockstep.is_done());
    slow->say(1, "no hello");
    slow->lockstep.held(50ms);
    CHECK(slow->lockstep.fault() ==
          "no message of type \"hello\" within 0.05 s from controller \"sleep 30\"");
    CHECK(slow->lockstep.time_to_end() == 400ms);

    const auto complete = run_of_three(50ms);
    complete->say(1, hello_b);
    complete->lockstep.held(1h);  // for a controller that somebody else starts
    CHECK_FALSE(complete->lockstep.is_done());

    const auto patient = run_of_three({});
    patient->lockstep.held(1h);
    CHECK_FALSE(patient->lockstep.is_done());
    CHECK(patient->lockstep.time_to_end() == 10s);
}

}  // namespace lockstep_test
