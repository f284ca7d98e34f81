// SPDX-License-Identifier: MIT
// Faults that are known of other simulators' AODV and DSR, one test each: what they do wrong is
// done right here. Names begin with the simulator.
#include "test/routing/aodv/aodv_node.hpp"
#include "test/routing/dsr/dsr_node.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <optional>

namespace known_faults_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::AodvNode;
using test::DsrNode;
using test::path;
using test::request;

TEST_CASE(
    "aodv, unlike ns-3: a request is forwarded even if it comes from the next hop to its "
    "destination") {
    AodvNode n;
    n.learn(5, 2, 10, 3);
    aodv::Request asked = request(7, 5);
    asked.number = 11;  // newer than the route, so that node 0 cannot answer
    CHECK(n.hear(2, asked) == Fate::waiting);
    CHECK(n.sent<aodv::Request>().size() == 1);
}

TEST_CASE(
    "aodv, unlike ns-3: a request with an older sequence number does not change the route to its "
    "originator") {
    AodvNode n;
    n.hear(1, request(7, 5, 1, 20), 2);
    n.hear(2, request(7, 5, 2, 19), 1);
    CHECK(n.route(7)->next_hop == NodeId{1});
    CHECK(n.route(7)->number == std::optional<std::uint32_t>(20));
    n.hear(3, request(7, 5, 3, 21), 3);  // a newer one replaces it
    CHECK(n.route(7)->next_hop == NodeId{3});
}

TEST_CASE("aodv, unlike ns-3: a request makes an invalid route to its originator valid again") {
    AodvNode n;
    n.learn(7, 1, 20, 3);
    n.link.time += 4s;
    CHECK_FALSE(n.route(7)->is_valid);
    n.hear(2, request(7, 5, 1, 22), 2);
    CHECK(n.route(7)->is_valid);
}

TEST_CASE(
    "aodv, unlike ns-3: the route to a forwarding neighbour does not get the originator's sequence "
    "number") {
    AodvNode n;
    n.hear(2, request(7, 5, 1, 20), 3);
    REQUIRE(n.route(2));
    CHECK(n.route(2)->number != n.route(7)->number);
}

TEST_CASE(
    "aodv, unlike ns-3: a lost destination's sequence number is incremented before a RERR is "
    "sent") {
    AodvNode n;
    n.pass_reply(7, 2, 5, 1, 9);
    n.forward(7, 2, 5);
    n.fail_last();
    const auto errors = n.sent<aodv::Error>();
    REQUIRE(errors.size() == 1);
    REQUIRE(errors[0].second.lost.back().destination == NodeId{5});
    CHECK(errors[0].second.lost.back().number == 10);
}

TEST_CASE(
    "aodv, unlike INET: requests with the same id but different originators are different "
    "requests") {
    AodvNode n;
    CHECK(n.hear(2, request(7, 5, 1)) == Fate::waiting);
    CHECK(n.hear(2, request(8, 5, 1)) == Fate::waiting);
    CHECK(n.hear(2, request(7, 5, 1)) == Fate::duplicate);
}

TEST_CASE(
    "aodv, unlike ns-2: during a repair, a reply as old as the broken route is not accepted") {
    // Node 0 loses its route to 5 and repairs it. The answer of a neighbour whose own route went
    // over node 0 has the number of the broken route, and is not accepted.
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1, 9);
    n.forward(7, 2, 5);
    n.fail_last();
    CHECK(n.sent<aodv::Request>().back().second.number == std::optional<std::uint32_t>(10));
    const auto before = n.data().size();
    n.hear(3, aodv::Reply{.hops = 1,
                          .destination = NodeId{5},
                          .number = 9,  // as old as the broken route
                          .originator = NodeId{0},
                          .lifetime = 3s});
    CHECK(n.data().size() == before);
    CHECK_FALSE(n.route(5)->is_valid);
}

TEST_CASE("aodv, unlike ns-2: a RERR does not drop messages for other destinations") {
    AodvNode n;
    n.learn(5, 2, 9);
    n.learn(6, 2, 9);
    n.send(6);
    n.hear(2, aodv::Error{.lost = {{NodeId{5}, 10}}});
    CHECK(n.link.drops.empty());
    CHECK(n.route(6)->is_valid);
    n.link.go();
    CHECK(n.data().size() == 1);
}

TEST_CASE("aodv, unlike ns-2: messages without a route cause at most ten RERRs a second") {
    AodvNode n;
    for (int i = 0; i < 50; ++i) n.forward(7, 2, 5);
    CHECK(n.sent<aodv::Error>().size() <= 10);
    CHECK(n.sent<aodv::Error>().size() >= 1);
    CHECK(n.link.drops.size() == 50);
}

TEST_CASE("aodv, unlike ns-2: an unanswered search ends, and its messages are dropped") {
    for (const bool as_ns2 : {false, true}) {
        AodvNode n({.profile = as_ns2 ? AodvProfile::ns2 : AodvProfile::rfc});
        for (int i = 0; i < 3; ++i) n.send(5);
        n.run(n.link.time + 300s);
        CHECK(n.link.drops.size() == 3);
        CHECK(n.sent<aodv::Request>().size() < 12);
        CHECK(n.link.timers.empty());
    }
}

TEST_CASE(
    "dsr, unlike ns-2: each node that forwards a request enlarges it only by the node's address") {
    DsrNode n;
    n.request(path({7}), 5, 1);
    n.request(path({7, 1}), 5, 2);
    n.request(path({7, 1, 2, 3}), 5, 3);
    const auto requests = n.sent(dsr::request_kind);
    REQUIRE(requests.size() == 3);
    const auto size = [&](int i) {
        return n.link.message(requests[static_cast<std::size_t>(i)].first.message).size;
    };
    CHECK(size(1) == size(0) + 4);
    CHECK(size(2) == size(1) + 8);
}

}  // namespace known_faults_test
