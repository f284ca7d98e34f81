// SPDX-License-Identifier: MIT
// Clients that share radios of a network's robots.
#include "experiment/client_radios.hpp"

#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <vector>

namespace client_radios_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Robots b and c, each 10 m beside a.
struct Three {
    Network net{{.seed = 1}};
    NodeId a = net.add({.name = "a", .at = {}});
    NodeId b = net.add({.name = "b", .at = {10, 0}});
    NodeId c = net.add({.name = "c", .at = {-10, 0}});
    Three() { net.route(Flood{}); }
};

}  // namespace

TEST_CASE(
    "client radios: if one of two clients of a radio leaves, the other one still receives "
    "messages") {
    Three robots;
    ClientRadios radios(robots.net);
    radios.join(1, {robots.b, robots.c}, true);
    radios.join(2, {robots.b}, true);
    CHECK(radios.has(2, robots.b));
    CHECK_FALSE(radios.has(2, robots.c));
    radios.leave(1);
    CHECK_FALSE(radios.has(1, robots.b));
    radios.send(robots.a, {.to = robots.b, .port = 7, .payload = "x"});
    robots.net.run_for(1s);
    const std::vector<HeardMessage> heard = radios.heard(2);
    REQUIRE(heard.size() == 1);
    CHECK(heard[0].last_hop == robots.a);
    CHECK(heard[0].level.has_value());
    CHECK(heard[0].port == 7);
    CHECK_FALSE(heard[0].is_for_everyone);
}

TEST_CASE(
    "client radios: a client gets simultaneous messages in the order of the receiving robots") {
    Three robots;
    ClientRadios radios(robots.net);
    radios.join(1, {robots.b, robots.c}, true);
    radios.send(robots.a, {.to = robots.c, .payload = "x"});
    radios.send(robots.a, {.to = robots.b, .payload = "y"});
    robots.net.run_for(1s);
    const std::vector<HeardMessage> heard = radios.heard(1);
    REQUIRE(heard.size() == 2);
    CHECK(heard[0].time == heard[1].time);
    CHECK(heard[0].at == robots.b);
    CHECK(heard[1].at == robots.c);
}

TEST_CASE("client radios: if a robot is off, it cannot send, and no message number is used up") {
    Three robots;
    ClientRadios radios(robots.net);
    radios.join(1, {robots.a, robots.b}, true);
    const auto first = radios.send(robots.a, {.payload = "x"});
    REQUIRE(first.has_value());
    robots.net.switch_off(robots.a);
    CHECK_FALSE(radios.send(robots.a, {.port = 9, .payload = "y"}).has_value());
    robots.net.switch_on(robots.a);
    CHECK(radios.send(robots.a, {.payload = "z"}) == *first + 1);
    robots.net.run_for(1s);
    for (const HeardMessage& each : radios.heard(1)) CHECK(each.port == 0);
}

}  // namespace client_radios_test
