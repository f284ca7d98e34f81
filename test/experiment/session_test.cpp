// SPDX-License-Identifier: MIT
// A scenario that is run from outside.
#include "experiment/session.hpp"

#include "experiment/reports/link_report.hpp"
#include "experiment/run.hpp"
#include "mobility/waypoints.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/drawn_map.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace session_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

Scenario scenario(const std::string& more = {}) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("s.toml", R"([scenario]
duration = "20 s"
[propagation]
model = "disc"
range = "30 m"
[[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["10 m", "0 m"]
[[robot]]
name = "c"
at = ["20 m", "0 m"]
[[traffic]]
from = "a"
payload = "tick"
every = "3 s"
)" + more),
                         {});
}

/// The fingerprint of a session that somebody drives.
template <class Act>
std::string fingerprint_of(Act act) {
    Session session(scenario());
    const auto fingerprint = std::make_shared<Fingerprint>();
    session.network().add_sink(fingerprint);
    act(session);
    session.step(session.end());
    return fingerprint->text();
}

}  // namespace

TEST_CASE("session: a run in one piece, in steps, or paced by the clock has the same fingerprint") {
    const std::string whole = fingerprint_of([](Session&) {});
    CHECK(fingerprint_of([](Session& s) {
              for (Time t = start_of_run; t < s.end(); t += 170ms) s.step(t);
          }) == whole);
    CHECK(fingerprint_of([](Session& s) { CHECK(s.run({}, {})); }) == whole);
    CHECK(fingerprint_of([](Session& s) { CHECK(s.run(1e300, {})); }) == whole);
    double last = 0;
    CHECK(fingerprint_of([&](Session& s) {
              CHECK(s.run(200, [&](double share) { return last = share, true; }));
          }) == whole);
    CHECK(last == 1);
    Session stopped{scenario()};
    CHECK_FALSE(stopped.run({}, [](double) { return false; }));
}

TEST_CASE("session: no step goes beyond the scenario's end") {
    Session session{scenario()};
    session.step(start_of_run + 1h);
    CHECK(session.network().now() == session.end());
}

TEST_CASE("session: a client drives its robots and receives the messages that they hear") {
    Session session{scenario()};
    Network& net = session.network();
    const NodeId a{0}, b{1}, c{2};
    const ClientId client = session.attach({b, c});
    session.drive(client, b, {1}, {0});
    session.send(client, c, std::nullopt, "hello");
    session.send(client, c, a, "you");
    session.step(start_of_run + 2s);
    CHECK(distance(net.position(b), {12, 0, 0}) < 1e-9);
    const auto heard = session.heard(client);
    REQUIRE(heard.size() == 3);  // both hear the tick, b hears c
    const auto hello = std::find_if(heard.begin(), heard.end(),
                                    [](const auto& each) { return each.payload == "hello"; });
    REQUIRE(hello != heard.end());
    CHECK(hello->at == b);
    CHECK(hello->from == c);
    CHECK(hello->hops == 1);
    CHECK(std::is_sorted(heard.begin(), heard.end(),
                         [](const auto& x, const auto& y) { return x.time < y.time; }));
    CHECK(session.heard(client).empty());
    session.move(client, b, Waypoints{.path = {{12, 5, 0}}, .speed = {5}});
    session.step(start_of_run + 5s);
    CHECK(net.position(b) == Vec3{12, 5, 0});
}

TEST_CASE("session: the same commands at the same times give the same records") {
    const auto driven = [](Session& s) {
        const ClientId client = s.attach({NodeId{1}});
        for (int i = 0; i < 10; ++i) {
            s.drive(client, {1}, {0.5 + 0.1 * i}, {0.3 * (i % 3)}, 700ms);
            s.send(client, {1}, std::nullopt, "here");
            s.step(s.network().now() + 1s);
        }
    };
    CHECK(fingerprint_of(driven) == fingerprint_of(driven));
    CHECK(fingerprint_of(driven) != fingerprint_of([](Session&) {}));
}

TEST_CASE(
    "session: a robot has one driver at a time; when a client leaves, others may drive its "
    "robots") {
    Session session{scenario()};
    Network& net = session.network();
    const ClientId first = session.attach({NodeId{1}});
    CHECK_THROWS_WITH_AS(session.attach({NodeId{1}}),
                         "robot b is already driven by a different client", std::invalid_argument);
    CHECK_THROWS_WITH_AS(session.drive(first, {2}, {1}, {0}),
                         "robot c is not attached to this client: attach the robot first",
                         std::invalid_argument);
    session.drive(first, {1}, {1}, {0.5});
    session.step(start_of_run + 1s);
    session.detach(first);
    const Vec3 left = net.position({1});
    CHECK_THROWS_AS(session.heard(first), std::invalid_argument);
    const ClientId second = session.attach({NodeId{1}});
    session.step(start_of_run + 5s);
    CHECK(net.position({1}) == left);
    CHECK(session.heard(second).size() == 1);  // the tick at 3 s
}

TEST_CASE("session: one client may use the radio of a robot while another client drives it") {
    Session session{scenario()};
    Network& net = session.network();
    const NodeId a{0}, b{1}, c{2};
    const ClientId driver = session.attach({b, c});
    const ClientId radios = session.attach_radios({a, b, c}, "radios");
    session.drive(driver, b, {1}, {0});
    CHECK_THROWS_WITH_AS(session.drive(radios, b, {1}, {0}),
                         "robot b is not attached to this client: attach the robot first",
                         std::invalid_argument);
    CHECK_THROWS_AS(session.send(driver, a, {}, "of another"), std::invalid_argument);
    session.send(radios, c, std::nullopt, "hello");
    session.step(start_of_run + 1s);
    std::vector<HeardMessage> of_both = session.heard(radios);
    REQUIRE(of_both.size() == 4);  // the tick of a at b and c, the hello of c at a and b
    std::erase_if(of_both, [&](const HeardMessage& each) { return each.at == a; });
    REQUIRE(of_both.size() == 3);
    for (const HeardMessage& each : of_both) CHECK(each.level.has_value());
    CHECK(session.heard(driver) == of_both);

    const ClientId others = session.attach_radios({b});
    session.detach(others);
    CHECK(session.twist(b).speed == 1);  // it had not driven it
    session.detach(driver);
    const Vec3 left = net.position(b);
    session.send(radios, c, std::nullopt, "again");
    session.step(start_of_run + 2s);
    CHECK(net.position(b) == left);
    CHECK(session.heard(radios).size() == 2);  // at a and b
    session.detach(radios);
    session.attach({a, b, c});
}

TEST_CASE("session: a network that outlives its session continues without clients") {
    std::shared_ptr<Network> network;
    {
        Session session{scenario()};
        CHECK_THROWS_WITH_AS(session.attach({NodeId{1}, NodeId{1}}), "robot b is listed twice",
                             std::invalid_argument);
        session.attach({NodeId{1}});
        network = session.shared_network();
    }
    network->run_for(5s);
    CHECK(network->metrics().deliveries == 4);  // two ticks, heard by two
}

TEST_CASE("session: a robot that cannot follow its command is reported as stalled") {
    const TemporaryFolder folder;
    folder.write("m.pgm", "P2 4 1 255 255 255 255 0");
    Session session(load_scenario(folder.write("s.toml", R"([scenario]
duration = "60 s"
[scene]
map = "m.pgm"
size = ["4 m", "1 m"]
[[robot]]
name = "r"
at = ["0.5 m", "0.5 m"]
radius = "0.2 m"
)"),
                                  {}));
    const ClientId client = session.attach({NodeId{0}});
    CHECK_FALSE(session.is_stalled({0}));
    session.drive(client, {0}, {1}, {0});
    session.step(start_of_run + 1s);
    CHECK_FALSE(session.is_stalled({0}));
    session.step(start_of_run + 10s);
    CHECK(session.is_stalled({0}));
    session.drive(client, {0}, {-1}, {0}, 1s);
    session.step(start_of_run + 10500ms);
    CHECK_FALSE(session.is_stalled({0}));
    session.step(start_of_run + 20s);
    CHECK_FALSE(session.is_stalled({0}));  // the command has ended
}

TEST_CASE("session: a received message has last hop, level of the frame, and port") {
    const TemporaryFolder folder;
    const Scenario line = load_scenario(folder.write("s.toml", R"([scenario]
duration = "20 s"
[propagation]
model = "friis"
[radio]
sensitivity = "-70 dBm"
[[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["150 m", "0 m"]
[[robot]]
name = "c"
at = ["300 m", "0 m"]
)"),
                                        {});
    Session session(line);
    const ClientId client = session.attach({NodeId{0}, NodeId{1}, NodeId{2}}, "ears");
    const auto uid =
        session.carry_out(client, {0}, SendCommand{.port = 7, .payload = std::string("F\0x", 3)});
    CHECK(uid == 0);
    session.step(start_of_run + 1s);
    const auto heard = session.heard(client);
    REQUIRE(heard.size() == 2);
    CHECK(heard[0].at == NodeId{1});
    CHECK(heard[0].last_hop == NodeId{0});
    CHECK(heard[1].at == NodeId{2});
    CHECK(heard[1].from == NodeId{0});
    CHECK(heard[1].last_hop == NodeId{1});
    CHECK(heard[1].hops == 2);
    CHECK(heard[1].port == 7);
    CHECK(heard[1].payload == std::string("F\0x", 3));
    const LinkReport link = report_link(line, "b", "c", start_of_run);
    REQUIRE(heard[1].level.has_value());
    CHECK(std::abs(heard[1].level->value - link.received.value) < 1e-9);
    // A later message has a port of its own, and one without has none.
    session.carry_out(client, {1}, SendCommand{.to = NodeId{2}, .payload = "x"});
    session.carry_out(client, {1}, SendCommand{.to = NodeId{2}, .port = 9, .payload = "y"});
    session.step(start_of_run + 2s);
    const auto later = session.heard(client);
    REQUIRE(later.size() == 2);
    CHECK(later[0].port + later[1].port == 9);
    // What comes while it does not hear is not kept, nor is what it had not asked for.
    const auto say = [&](const char* payload, Duration until) {
        session.carry_out(client, {1}, SendCommand{.to = NodeId{2}, .payload = payload});
        session.step(start_of_run + until);
    };
    say("not asked for", 3s);
    session.set_hearing(client, false);
    say("not heard", 4s);
    session.set_hearing(client, true);
    say("heard again", 5s);
    const auto last = session.heard(client);
    REQUIRE(last.size() == 1);
    CHECK(last[0].payload == "heard again");
}

TEST_CASE("session: a message from a robot to itself is refused, and is not reported as an input") {
    std::size_t inputs = 0;
    fingerprint_of([&](Session& s) {
        s.on_input([&](const Input&) { ++inputs; });
        const ClientId client = s.attach({NodeId{1}}, "pilot");
        const SendCommand to_itself{.to = NodeId{1}, .payload = "x"};
        CHECK(s.why_not({1}, to_itself).starts_with("a robot cannot send to itself; expected"));
        CHECK_THROWS_AS(s.carry_out(client, {1}, to_itself), std::invalid_argument);
        CHECK(inputs == 0);
        s.carry_out(client, {1}, SendCommand{.to = NodeId{2}, .payload = "x"});
        CHECK(inputs == 1);
    });
}

TEST_CASE("session: every command is reported as an input, also the stop when a client leaves") {
    const auto driven = [](Session& s, std::vector<Input>& inputs) {
        s.on_input([&](const Input& input) { inputs.push_back(input); });
        const ClientId client = s.attach({NodeId{1}, NodeId{2}}, "pilot");
        s.carry_out(client, {1}, DriveCommand{{1}, {0.5}, 4s}, 1);
        s.step(start_of_run + 3s);
        s.carry_out(client, {2}, GoalCommand{{20, 3, 0}, {0.5}}, 2);
        s.carry_out(client, {2}, SendCommand{.port = 3, .payload = "here", .size = 100}, 3);
        s.step(start_of_run + 3500ms);
        s.detach(client);
    };
    std::vector<Input> inputs;
    const std::string first = fingerprint_of([&](Session& s) { driven(s, inputs); });
    REQUIRE(inputs.size() == 5);
    CHECK(inputs[1].time == start_of_run + 3s);
    CHECK(inputs[2].client == "pilot");
    CHECK(inputs[2].number == 3);
    CHECK(std::holds_alternative<StopCommand>(inputs[4].command));
    CHECK(fingerprint_of([&](Session& s) {
              const ClientId all = s.attach({NodeId{1}, NodeId{2}});
              for (const Input& input : inputs) {
                  s.step(input.time);
                  s.carry_out(all, input.robot, input.command);
              }
          }) == first);
}

TEST_CASE(
    "session: a robot has the commanded velocity while it is driven, else that of its movement") {
    Session session{scenario()};
    const ClientId client = session.attach({NodeId{1}});
    CHECK(session.driver({1}) == client);
    CHECK_FALSE(session.driver({0}).has_value());
    session.drive(client, {1}, {-0.5}, {0.25});
    session.step(start_of_run + 1s);
    CHECK(session.twist({1}).speed == -0.5);
    CHECK(session.twist({1}).turn_rate == 0.25);
    session.carry_out(client, {1}, GoalCommand{{50, 0, 0}, {2}});
    session.step(start_of_run + 2s);
    CHECK(std::abs(session.twist({1}).speed - 2) < 1e-9);
    session.carry_out(client, {1}, StopCommand{});
    CHECK(session.twist({1}).speed == 0);
    session.drive(client, {1}, {0}, {1}, 2s);
    session.step(start_of_run + 3s);
    CHECK(session.twist({1}).turn_rate == 1);
    session.step(start_of_run + 5s);
    CHECK(session.twist({1}).turn_rate == 0);
}

TEST_CASE(
    "session: a robot that is placed elsewhere has the commanded position and heading, and stands "
    "still") {
    Session session{scenario()};
    const ClientId client = session.attach({NodeId{1}});
    session.drive(client, {1}, {1}, {0});
    session.step(start_of_run + 1s);
    session.carry_out(client, {1}, PlaceCommand{{5, 6, 0}, {1.5}});
    session.step(start_of_run + 2s);
    CHECK(session.network().position({1}) == Vec3{5, 6, 0});
    CHECK(session.network().heading({1}).value == 1.5);
    CHECK(session.twist({1}).speed == 0);
}

TEST_CASE(
    "session: events that a command causes at the same instant are processed before the next "
    "command") {
    struct Order {
        std::string& text;
        KindMask kinds() const { return kind_of<Sent>() | kind_of<Transmitted>(); }
        void on(const Record& record, const RecordContext&) {
            text += std::holds_alternative<Sent>(record) ? 's' : 't';
        }
    };
    Session session{scenario("[access]\nmodel = \"aloha\"\n")};
    const ClientId client = session.attach({{1}, {2}});
    session.step(start_of_run + 1s);
    std::string order;  // sent, transmitted
    session.network().add_sink(std::make_shared<Order>(Order{order}));
    for (const NodeId robot : {NodeId{1}, NodeId{2}}) session.send(client, robot, {}, "x");
    session.step(start_of_run + 1s);
    CHECK(order == "stst");
}

TEST_CASE("session: a range finder sees walls and robots from the position of its robot") {
    Session session{scenario(R"([[robot]]
name = "d"
count = 2
at = ["0 m", "3 m"]
radius = "0.5 m"
scan = { beams = 3, range = "20 m" }
)")};
    const auto d = *session.network().find("d1");
    REQUIRE(session.range_finders(d).size() == 1);
    CHECK(session.range_finders({0}).empty());
    CHECK_THROWS_AS(session.scan({0}), std::out_of_range);
    CHECK_THROWS_AS(session.scan(d, 1), std::out_of_range);
    CHECK(session.scan(d)[0] == 0);  // its twin is where it is
    session.network().place(*session.network().find("d0"), {0, -9});
    // Down, at 3 m less its radius, is the robot a; ahead and up there is nobody.
    const auto sees = [&](double right, double ahead, double left) {
        const std::vector<double> ranges = session.scan(d);
        return std::abs(ranges[0] - right) < 1e-12 && ranges[1] == ahead &&
               std::abs(ranges[2] - left) < 1e-12;
    };
    CHECK(sees(2.8, 20, 20));
    session.network().place({0}, {0, 9});
    CHECK(sees(11.5, 20, 5.8));
    session.network().take_away({0}, Presence::left);
    CHECK(session.scan(d)[2] == 20);
}

TEST_CASE("session: range finders are numbered, each at its position on the robot") {
    Session session{scenario(R"([[robot]]
name = "d"
at = ["0 m", "3 m"]
heading = "90 deg"
[[robot.scan]]
beams = 1
from = "0 deg"
to = "0 deg"
range = "30 m"
[[robot.scan]]
kind = "sonar"
at = ["-0.5 m", "0 m"]
heading = "180 deg"
angles = ["0 deg", "90 deg"]
places = [["0.1 m", "0 m"], ["0 m", "0 m"]]
)")};
    const auto d = *session.network().find("d");
    REQUIRE(session.range_finders(d).size() == 2);
    CHECK(session.range_finders(d)[1].label() == "sonar");
    CHECK(session.scan(d) == std::vector<double>{30});
    // The sonar looks back from (0, 2.5), its first beam from (0, 2.4): robot a is at (0, 0).
    const std::vector<double> ranges = session.scan(d, 1);
    REQUIRE(ranges.size() == 2);
    CHECK(std::abs(ranges[0] - 2.2) < 1e-12);
    CHECK(ranges[1] == 8);
}

TEST_CASE("session: a range finder sees only robots of its own storey") {
    Scenario on_two = scenario(
        "[[robot]]\nname = \"d\"\nat = [\"1 m\", \"1 m\"]\n"
        "scan = { beams = 1, from = \"0 deg\", to = \"0 deg\" }\n");
    OccupancyGrid upper = test::drawn_map({"........", "........"});
    upper.origin.z = 3;
    on_two.walls = std::make_shared<const Scene>(
        std::vector{test::drawn_map({"........", "........"}), upper}, std::vector{Material{}});
    Session session(on_two);
    const NodeId d = *session.network().find("d");
    session.network().place({0}, {5, 1, 3});
    CHECK(session.scan(d)[0] == 8);
    session.network().place({0}, {5, 1, 0});
    CHECK(session.scan(d)[0] == doctest::Approx(3.8));
}

}  // namespace session_test
