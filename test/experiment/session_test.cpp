// SPDX-License-Identifier: MIT
// A scenario that is run from outside.
#include "experiment/session.hpp"

#include "mobility/waypoints.hpp"
#include "scenario/scenario.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
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

TEST_CASE("session: the same run in one piece, in steps and paced") {
    const std::string whole = fingerprint_of([](Session&) {});
    CHECK(fingerprint_of([](Session& s) {
              for (Time t = start_of_run; t < s.end(); t += 170ms) s.step(t);
          }) == whole);
    CHECK(fingerprint_of([](Session& s) { CHECK(s.run({}, {})); }) == whole);
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

TEST_CASE("session: a client drives its robots, and hears what they hear") {
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

TEST_CASE("session: a robot has one driver; a client that leaves takes all that is its with it") {
    Session session{scenario()};
    Network& net = session.network();
    const ClientId first = session.attach({NodeId{1}});
    CHECK_THROWS_WITH_AS(session.attach({NodeId{1}}), "robot b is driven by another client already",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(session.drive(first, {2}, {1}, {0}),
                         "robot c is not the client's: attach it first", std::invalid_argument);
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

TEST_CASE("session: a network that outlives its session goes on without its clients") {
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

TEST_CASE("session: a robot that cannot go where it is driven is stalled") {
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

}  // namespace session_test
