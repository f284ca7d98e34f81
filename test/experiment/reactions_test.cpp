// SPDX-License-Identifier: MIT
// What robots of a scenario do when something happens, and robots that a movement file moves.
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/whereabouts.hpp"
#include "experiment/run.hpp"
#include "experiment/timeline.hpp"
#include "models/medium/medium.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace reactions_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

/// Robots a, b and c in a line, 8 m apart, of 10 m reach; `extra` goes to b's table.
std::string line_of_three(const std::string& extra, const std::string& rest = "") {
    return "[scenario]\nduration = \"60 s\"\n[propagation]\nmodel = \"disc\"\nrange = \"10 m\"\n"
           "[[robot]]\nname = \"a\"\nat = [\"0 m\", \"0 m\"]\n[[robot]]\nname = \"c\"\n"
           "at = [\"16 m\", \"0 m\"]\n[[robot]]\nname = \"b\"\nat = [\"8 m\", \"0 m\"]\n" +
           extra + "\n" + rest;
}

const std::string a_says = "[[traffic]]\nfrom = \"a\"\npayload = \"go\"\nstart = \"1 s\"\n";
const std::string c_says = "[[traffic]]\nfrom = \"c\"\npayload = \"go\"\nstart = \"2 s\"\n";

/// Who said what, in order: "b: heard".
std::vector<std::string> said(const std::string& scenario) {
    const TemporaryFolder folder;
    const Scenario s = load_scenario(folder.write("s.toml", scenario), {});
    const RunResult result = run_scenario(s, {.folder = folder.path("out"), .speed = {}});
    std::vector<std::string> words;
    for (std::size_t i = 0; i < result.timeline->size(); ++i) {
        const auto [time, robot, text] = (*result.timeline)[i];
        if (!text.starts_with("says ")) continue;
        words.push_back(robot + ": " + text.substr(6, text.size() - 7));
    }
    return words;
}

Vec3 place_of(const std::string& scenario, const std::string& robot, double t) {
    const TemporaryFolder folder;
    const Scenario s = load_scenario(folder.write("s.toml", scenario), {});
    const auto then = whereabouts(s, {start_of_run + from_seconds(t)});
    for (const auto& row : then.front().robots) {
        if (row.name == robot) return row.position;
    }
    return {NAN, NAN, NAN};
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE(
    "reactions: the first bytes of a message, its origin or its number of hops can trigger a "
    "reaction") {
    CHECK(said(line_of_three("on_receive = { payload = \"g\", send = \"yes\" }", a_says)) ==
          Words{"a: go", "b: yes"});
    CHECK(said(line_of_three("on_receive = { payload = \"x\", send = \"yes\" }", a_says)) ==
          Words{"a: go"});
    CHECK(said(line_of_three("on_receive = { from = \"c\", send = \"yes\" }", a_says + c_says)) ==
          Words{"a: go", "c: go", "b: yes"});
    const std::string relayed =
        "[[robot]]\nname = \"d\"\nat = [\"24 m\", \"0 m\"]\n"
        "on_receive = { hops = #, send = \"near\" }\n";
    for (const auto& [hops, answers] : {std::pair{"1", false}, {"2", true}}) {
        std::string d = relayed;
        d.replace(d.find('#'), 1, hops);
        const auto words =
            said(line_of_three("", d + "[[traffic]]\nfrom = \"b\"\npayload = \"go\"\n"));
        CHECK(std::count(words.begin(), words.end(), "d: near") == (answers ? 1 : 0));
    }
}

TEST_CASE("reactions: a time, or the end of a movement, triggers a reaction") {
    CHECK(said(line_of_three("on_time = [{ time = \"3 s\", send = \"three\" }, "
                             "{ time = \"5 s\", send = \"five\" }]",
                             a_says)) == Words{"a: go", "b: three", "b: five"});
    CHECK(said(line_of_three("move = { model = \"goal\", to = [\"8 m\", \"4 m\"] }\n"
                             "on_arrival = { send = \"there\" }")) == Words{"b: there"});
}

TEST_CASE("reactions: a robot that loses a signal moves, sends a message or stops") {
    const std::string leaving = "move = { model = \"goal\", to = [\"8 m\", \"60 m\"] }\n";
    // From (8, y) a robot at (0, 0) is heard up to y = 6.
    const std::string stops =
        line_of_three(leaving + "on_link_lost = { from = \"a\", stop = true }");
    CHECK(std::abs(place_of(stops, "b", 30).y - 6) < 1e-4);
    const std::string home = line_of_three(
        leaving + "on_link_lost = { move = { model = \"goal\", to = [\"8 m\", \"0 m\"] } }");
    CHECK(std::abs(place_of(home, "b", 8).y - 4) < 1e-4);
    CHECK(place_of(home, "b", 30).y == 0);
}

TEST_CASE(
    "reactions: a movement that cannot begin is an error with line and column of the movement") {
    const auto error_of = [](const std::string& movement) -> std::string {
        const TemporaryFolder folder;
        const std::string file = folder.write(
            "s.toml",
            line_of_three("on_time = { time = \"70 s\", move = { model = " + movement + " } }"));
        try {
            network_at(load_scenario(file, {}), start_of_run);
        } catch (const InputError& error) {
            return std::string(error.what()).substr(file.size());
        }
        return "no error";
    };
    // The reaction comes after the end of the run, so its movement never begins.
    CHECK(error_of("\"wander\"").starts_with(":15:35: wander: "));
    CHECK(error_of("\"random_direction\"")
              .starts_with(":15:35: random_direction: the key \"area\" "
                           "must be"));
    const std::string area = "area = [[\"50 m\", \"0 m\"], [\"90 m\", \"9 m\"]]";
    CHECK(error_of("\"random_waypoint\", min_speed = \"9 m/s\", max_speed = \"3 m/s\", " + area) ==
          ":15:35: random_waypoint: max_speed must be >= min_speed = 9, got 3");
    CHECK(error_of("\"random_walk\", " + area) == "no error");
}

TEST_CASE(
    "reactions: if a robot is outside the area of its movement, the error names robot and time") {
    const std::string outside = line_of_three(
        "on_time = { time = \"1.5 s\", move = { model = \"random_walk\", "
        "area = [[\"50 m\", \"0 m\"], [\"90 m\", \"9 m\"]] } }");
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", outside);
    std::string error = "no error";
    try {
        network_at(load_scenario(file, {}), start_of_run + from_seconds(2));
    } catch (const InputError& thrown) {
        error = std::string(thrown.what()).substr(file.size());
    }
    CHECK(error ==
          ":15:36: on_time of robot \"b\" at 1.5 s: random_walk: the robot must begin inside the "
          "area from (50, 0) to (90, 9) m, but is at (8, 0) m");
}

TEST_CASE("movement file: the file creates the robots that it names, and moves existing robots") {
    const TemporaryFolder folder;
    folder.write("walk.tcl",
                 "$node_(0) set X_ 1\n$node_(0) set Y_ 0\n$node_(1) set X_ 5\n$node_(1) set Y_ 0\n"
                 "$ns_ at 2.0 \"$node_(0) setdest 1 10 1\"\n"
                 "$ns_ at 7.0 \"$node_(0) setdest 11 5 2\"\n");
    const std::string text =
        "[scenario]\nduration = \"20 s\"\n[movement]\nfile = \"walk.tcl\"\n"
        "[[robot]]\nname = \"n0\"\nradio = { power = \"3 dBm\" }\n"
        "[[traffic]]\nfrom = \"n1\"\npayload = \"x\"\n";
    const Scenario s = load_scenario(folder.write("s.toml", text), {});
    const auto network = network_at(s, start_of_run + from_seconds(9));
    REQUIRE(network->size() == 2);
    const NodeId n0 = *network->find("n0");
    CHECK(network->medium().stations().radio(n0).power == Dbm{3});
    // At 7 s it was at (1, 5); from there 2 s at 2 m/s.
    CHECK(distance(network->position(n0), {5, 5, 0}) < 1e-9);
    CHECK(run_scenario(s, {.folder = folder.path("out"), .speed = {}}).metrics.messages == 1);
    CHECK(to_document(s).find("movement")->table()->find("file"));
}

TEST_CASE("movement file: a vehicle is silent before it appears and after it is gone") {
    const TemporaryFolder folder;
    folder.write("fcd.xml", R"(<fcd-export>
    <timestep time="0.00"><vehicle id="car" x="0" y="0" angle="90" speed="1"/></timestep>
    <timestep time="1.00"><vehicle id="car" x="2" y="0" angle="90" speed="2"/><vehicle id="bus" x="9" y="0"/></timestep>
    <timestep time="2.00"><vehicle id="bus" x="9" y="4"/></timestep>
    <timestep time="3.00"/>
</fcd-export>
)");
    const Scenario s = load_scenario(folder.path("fcd.xml"), {});
    const auto at = [&](double t) { return network_at(s, start_of_run + from_seconds(t)); };
    const auto on = [](const Network& net, const char* name) {
        return net.medium().stations().is_on(*net.find(name));
    };
    CHECK(on(*at(0.5), "car"));
    CHECK_FALSE(on(*at(0.5), "bus"));
    CHECK(on(*at(1.5), "bus"));
    CHECK_FALSE(on(*at(1.5), "car"));
    CHECK(distance(at(1.5)->position(*at(0)->find("bus")), {9, 2, 0}) < 1e-9);
    CHECK(std::abs(at(0.5)->heading(*at(0)->find("car")).value) < 1e-9);
}

TEST_CASE("reactions: an answer goes to the sender of the message, or to a robot by name") {
    const auto deliveries = [](const std::string& reaction) {
        const TemporaryFolder folder;
        const Scenario s =
            load_scenario(folder.write("s.toml", line_of_three(reaction, a_says)), {});
        const RunResult result = run_scenario(s, {.folder = folder.path("out"), .speed = {}});
        std::vector<std::string> heard;
        for (std::size_t i = 0; i < result.timeline->size(); ++i) {
            const Timeline::Happening happening = (*result.timeline)[i];
            if (happening.text.find("hears \"yes\"") != std::string::npos) {
                heard.push_back(happening.robot);
            }
        }
        return heard;
    };
    CHECK(deliveries("on_receive = { send = \"yes\", to = \"sender\" }") == Words{"a"});
    CHECK(deliveries("on_receive = { send = \"yes\", to = \"c\" }") == Words{"c"});
    CHECK(deliveries("on_time = { time = \"5 s\", send = \"yes\", to = \"c\" }") == Words{"c"});
    CHECK(deliveries("on_receive = { send = \"yes\" }") == Words{"a", "c"});
    const std::string every = "every = \"2 s\"\ncount = 3\n";
    CHECK(said(line_of_three("on_receive = { send = \"yes\", to = \"sender\", once = false }",
                             a_says + every))
              .front() == "a: go");
}

TEST_CASE("reactions: a robot that answers every request sends exactly one answer per request") {
    const TemporaryFolder folder;
    const std::string scenario = line_of_three(
        "on_receive = { send = \"yes\", to = \"sender\", once = false }",
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"a\"\nto = \"b\"\npayload = \"ask\"\n"
        "every = \"1 s\"\ncount = 5\n");
    const Scenario s = load_scenario(folder.write("s.toml", scenario), {});
    const RunResult result = run_scenario(s, {.folder = folder.path("out"), .speed = {}});
    CHECK(result.metrics.messages == 10);
    CHECK(result.metrics.deliveries == 10);
}

TEST_CASE("reactions: traffic that starts when a robot arrives sends nothing after its stop time") {
    const std::string moving = "move = { model = \"goal\", to = [\"8 m\", \"5 m\"] }\n";
    const std::string arrives =
        "[[traffic]]\nfrom = \"b\"\npayload = \"here\"\nstart = \"arrival\"\nevery = \"1 s\"\n";
    CHECK(said(line_of_three(moving, arrives + "stop = \"3 s\"\n")) == Words{});
    CHECK(said(line_of_three(moving, arrives + "stop = \"30 s\"\n")) == Words{"b: here"});
}

}  // namespace reactions_test
