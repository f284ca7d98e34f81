// SPDX-License-Identifier: MIT
// AODV's rules one by one, by receptions that the test makes up. Names begin with the section of
// RFC 3561, or with the rule that goes beyond its text (routing/aodv/aodv_router.hpp).
#include "test/routing/aodv/aodv_node.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace aodv_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::AodvNode;
using test::request;

TEST_CASE("aodv 5: packets have exactly the bytes that the RFC defines, and can be decoded again") {
    aodv::Request asked = request(1, 2, 0x01020304, 7);
    const std::string bytes = aodv::to_bytes(asked);
    CHECK(bytes == std::string("\1\x08\0\0\1\2\3\4\0\0\0\2\0\0\0\0\0\0\0\1\0\0\0\7", 24));
    asked.number = 9;
    const auto back = std::get<aodv::Request>(aodv::packet_of(aodv::to_bytes(asked)));
    CHECK(back.number == std::optional<std::uint32_t>(9));
    CHECK(back.id == asked.id);
    const std::string reply = aodv::to_bytes(aodv::Reply{
        .hops = 3, .destination = NodeId{4}, .number = 5, .originator = NodeId{6}, .lifetime = 6s});
    CHECK(reply == std::string("\2\0\0\3\0\0\0\4\0\0\0\5\0\0\0\6\0\0\x17\x70", 20));
    const std::string error = aodv::to_bytes(aodv::Error{.lost = {{NodeId{1}, 2}, {NodeId{3}, 4}}});
    CHECK(error == std::string("\3\0\0\2\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\4", 20));
    for (const std::string& broken :
         {std::string("\1"), bytes.substr(1), reply + "x",
          std::string("\3\0\0\2\0\0\0\1\0\0\0\2", 12), std::string("\7abc"), std::string{}}) {
        CHECK(aodv::packet_of(broken).index() == 0);
    }
    // On air: the hops of this transmission, and IP addresses.
    const std::string there = aodv::on_air(reply, {.message = {}, .sender = {}, .hops = 3},
                                           [](NodeId n) { return 0x0a000000 + n.value; });
    CHECK(there == std::string("\2\0\0\5\x0a\0\0\4\0\0\0\5\x0a\0\0\6\0\0\x17\x70", 20));
}

TEST_CASE(
    "aodv 6.1: each request increments the node's sequence number; a reply has at least the "
    "requested number") {
    AodvNode n;
    n.send(5);
    CHECK(n.sent<aodv::Request>().back().second.originator_number == 1);
    aodv::Request asked = request(3, 0);
    asked.number = 40;  // raised by two nodes whose links broke
    n.hear(3, asked);
    CHECK(n.sent<aodv::Reply>().back().second.number == 40);
    asked.number = 7;
    ++asked.id;
    n.hear(3, asked);
    CHECK(n.sent<aodv::Reply>().back().second.number == 40);
}

TEST_CASE(
    "aodv 6.2: a route is accepted if it is newer, or equally new and shorter, or if no valid "
    "route exists") {
    AodvNode n;
    n.learn(5, 1, 10, 3);
    CHECK(n.route(5)->hops == 4);
    n.learn(5, 2, 9, 1);  // older
    CHECK(n.route(5)->next_hop == NodeId{1});
    n.learn(5, 2, 10, 3);  // as new, not shorter
    CHECK(n.route(5)->next_hop == NodeId{1});
    n.learn(5, 2, 10, 2);  // as new, shorter
    CHECK(n.route(5)->next_hop == NodeId{2});
    n.learn(5, 1, 11, 6);  // newer
    CHECK(n.route(5)->next_hop == NodeId{1});
    CHECK(n.route(5)->hops == 7);
    n.link.time += 4s;  // its time is over: the next number
    CHECK_FALSE(n.route(5)->is_valid);
    CHECK(n.route(5)->number == 12);
    n.learn(5, 2, 11, 1);  // older than the broken one
    CHECK_FALSE(n.route(5)->is_valid);
    n.learn(5, 2, 12, 9);  // as new as the broken one
    CHECK(n.route(5)->is_valid);
}

TEST_CASE(
    "aodv 6.2: a message extends the routes to its source, destination, last hop and next hop") {
    AodvNode n;
    n.learn(5, 1, 10, 3);
    n.hear(2, request(7, 9), 3);
    n.link.time += 2500ms;
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    for (const std::uint32_t to : {5U, 1U, 7U, 2U}) {
        CAPTURE(to);
        CHECK(n.route(to)->until == n.link.time + 3s);
    }
}

TEST_CASE(
    "aodv 6.3, 6.4: a search covers 1, 3, 5, 7 hops, then three times the whole network, and then "
    "fails") {
    AodvNode n;
    n.send(5);
    std::vector<int> ttls{n.sent<aodv::Request>().back().first.ttl};
    std::vector<double> waits;
    while (n.link.drops.empty()) {
        const Time before = n.link.time;
        n.wait();
        waits.push_back(seconds(n.link.time - before));
        if (n.link.drops.empty()) ttls.push_back(n.sent<aodv::Request>().back().first.ttl);
    }
    CHECK(ttls == std::vector<int>{1, 3, 5, 7, 35, 35, 35});
    CHECK(waits == std::vector<double>{0.24, 0.4, 0.56, 0.72, 2.8, 5.6, 11.2});
    CHECK(n.link.drops[0].reason == DropReason::no_route);
    CHECK(n.sent<aodv::Request>().back().second.id == 7);
    CHECK(n.sent<aodv::Request>().back().second.originator_number == 7);
}

TEST_CASE(
    "aodv 6.4: the search for a lost destination begins with a TTL of the last route's hops plus "
    "2") {
    AodvNode n;
    n.learn(5, 1, 10, 2);
    n.link.time += 4s;
    n.send(5);
    CHECK(n.sent<aodv::Request>().back().first.ttl == 5);
    CHECK(n.sent<aodv::Request>().back().second.number == std::optional<std::uint32_t>(11));
}

TEST_CASE("aodv 6.3: a node sends at most ten requests a second") {
    AodvNode n({}, 40);
    for (std::uint32_t to = 1; to <= 15; ++to) n.send(to);
    CHECK(n.sent<aodv::Request>().size() == 10);
    while (n.link.time < start_of_run + 900ms) n.wait();
    int first_second = 0;
    for (const auto& each : n.link.sent) first_second += each.at < start_of_run + 1s;
    CHECK(first_second == 10);
    n.wait();
    while (n.link.time < start_of_run + 1100ms) n.wait();
    CHECK(n.sent<aodv::Request>().size() > 10);
}

TEST_CASE(
    "aodv 6.5: a request is forwarded once, within its TTL, with the newest known destination "
    "sequence number") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    n.link.time += 4s;  // broken: number 21
    CHECK(n.hear(2, request(7, 5), 3, 4) == Fate::waiting);
    const auto [frame, asked] = n.sent<aodv::Request>().back();
    CHECK(frame.ttl == 3);
    CHECK(frame.hops == 4);
    CHECK(asked.number == std::optional<std::uint32_t>(21));
    CHECK(n.route(7)->next_hop == NodeId{2});
    CHECK(n.route(7)->hops == 3);
    CHECK(n.hear(3, request(7, 5), 1, 4) == Fate::duplicate);
    CHECK(n.hear(2, request(7, 8, 2), 3, 1) == Fate::ttl);
    CHECK(n.hear(2, request(0, 8)) == Fate::duplicate);  // its own
    CHECK(n.sent<aodv::Request>().size() == 1);
    CHECK(n.link.sent.back().at == n.link.time + 1us + 5ms);  // delayed at random
}

TEST_CASE(
    "aodv 6.1: a request is discarded if its originator's sequence number is older than the known "
    "one") {
    AodvNode n;
    n.learn(7, 1, 20, 3);
    n.link.time += 4s;
    CHECK(n.hear(2, request(7, 5, 1, 20), 3) == Fate::arrived);  // 21 is known
    CHECK_FALSE(n.route(7)->is_valid);
    CHECK(n.sent<aodv::Request>().empty());
}

TEST_CASE(
    "aodv 6.6.2: a node with a valid and new enough route replies, unless flag D (destination "
    "only) is set") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    aodv::Request asked = request(7, 5);
    asked.number = 21;
    CHECK(n.hear(2, asked) == Fate::waiting);
    ++asked.id, asked.number = 20, asked.destination_only = true;
    CHECK(n.hear(2, asked) == Fate::waiting);
    ++asked.id, asked.destination_only = false;
    CHECK(n.hear(2, asked) == Fate::arrived);
    const auto [frame, reply] = n.sent<aodv::Reply>().back();
    CHECK(frame.next_hop == NodeId{2});
    CHECK(reply.hops == 4);
    CHECK(reply.number == 20);
    CHECK(reply.lifetime == 3s);
}

TEST_CASE(
    "aodv 6.7: a node forwards a reply along the reverse route if it accepted the route in the "
    "reply") {
    AodvNode n;
    n.hear(2, request(7, 5), 3);
    const aodv::Reply reply{
        .hops = 1, .destination = NodeId{5}, .number = 9, .originator = NodeId{7}, .lifetime = 6s};
    CHECK(n.hear(1, reply, 2) == Fate::waiting);
    CHECK(n.sent<aodv::Reply>().back().first.next_hop == NodeId{2});
    CHECK(n.route(5)->hops == 3);
    CHECK(n.hear(3, reply, 2) == Fate::arrived);  // no better
    aodv::Reply stranger = reply;
    stranger.originator = NodeId{8}, stranger.number = 10;
    CHECK(n.hear(1, stranger, 2) == Fate::arrived);  // no way back
    CHECK(n.sent<aodv::Reply>().size() == 1);
}

TEST_CASE("aodv 6.8: if a neighbour did not get a reply, its requests are ignored for 5.6 s") {
    AodvNode n;
    n.hear(2, request(7, 0), 3);
    n.link.go();
    n.link.end(n.router, n.link.sent.size() - 1, SendResult::retries);
    CHECK_FALSE(n.route(7)->is_valid);  // a link that is broken
    CHECK(n.hear(2, request(7, 0, 2)) == Fate::arrived);
    CHECK(n.link.sent.size() == 1);
    n.link.time += 6s;
    n.hear(2, request(7, 0, 3, 9));
    CHECK(n.link.sent.size() == 2);
}

TEST_CASE("aodv 6.11: a broken link is reported only to neighbours that use routes over it") {
    AodvNode n;
    n.hear(2, request(7, 5), 3);
    n.hear(1,
           aodv::Reply{.hops = 1,
                       .destination = NodeId{5},
                       .number = 9,
                       .originator = NodeId{7},
                       .lifetime = 6s},
           2);
    n.learn(6, 1, 4, 3);  // of node 0 alone
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    n.link.go();
    n.link.end(n.router, n.link.sent.size() - 1, SendResult::retries);
    const auto errors = n.sent<aodv::Error>();
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].first.next_hop == NodeId{2});  // one user: unicast
    std::vector<std::pair<std::uint32_t, std::uint32_t>> lost;
    for (const auto& each : errors[0].second.lost)
        lost.emplace_back(each.destination.value, each.number);
    CHECK(lost == std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1, 0}, {5, 10}});
    CHECK_FALSE(n.route(6)->is_valid);
    CHECK(n.route(6)->number == 5);
    REQUIRE(n.link.drops.size() == 1);
    CHECK(n.link.drops[0].reason == DropReason::broken);
}

TEST_CASE("aodv 6.11: a message without a route is reported to the neighbour that sent it") {
    AodvNode n;
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    REQUIRE(n.link.drops.size() == 1);
    CHECK(n.link.drops[0].reason == DropReason::no_route);
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    CHECK(n.sent<aodv::Error>()[0].first.next_hop == NodeId{2});
    for (int i = 0; i < 30; ++i) n.forward(7, 2, 5);
    CHECK(n.sent<aodv::Error>().size() == 10);  // at most ten a second
}

TEST_CASE(
    "aodv, rule A14: a RERR never decreases a sequence number, and is ignored unless it comes from "
    "the next hop") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    const auto report = [&](std::uint32_t from, std::uint32_t number) {
        n.hear(from, aodv::Error{.lost = {{NodeId{5}, number}}});
    };
    report(2, 21);
    CHECK(n.route(5)->is_valid);  // not its next hop
    report(1, 15);
    CHECK(n.route(5)->is_valid);  // stale
    CHECK(n.route(5)->number == 20);
    report(1, 25);
    CHECK_FALSE(n.route(5)->is_valid);
    CHECK(n.route(5)->number == 25);
    n.learn(5, 1, 30, 3);
    report(1, 0);  // the sender does not know the number
    CHECK_FALSE(n.route(5)->is_valid);
    CHECK(n.route(5)->number == 31);
}

TEST_CASE("aodv, rule A15: no node has a route to itself") {
    AodvNode n;
    n.hear(1, aodv::Reply{.hops = 2,
                          .destination = NodeId{0},
                          .number = 99,
                          .originator = NodeId{7},
                          .lifetime = 6s});
    n.hear(2, request(0, 5, 7, 99), 3);
    CHECK_FALSE(n.route(0));
}

TEST_CASE("aodv, rule A16: a route that is learnt in any way ends the search for its destination") {
    AodvNode n;
    n.send(7);
    CHECK(n.data().empty());
    n.hear(2, request(7, 5), 3);  // its own request
    REQUIRE(n.data().size() == 1);
    CHECK(n.data()[0].next_hop == NodeId{2});
    const std::size_t asked = n.sent<aodv::Request>().size();
    n.wait();
    CHECK(n.sent<aodv::Request>().size() == asked);
}

TEST_CASE(
    "aodv 6.12: a node near the destination repairs a broken route, and reports a failed repair") {
    AodvNode n({.local_repair = true});
    n.hear(2, request(7, 5), 3);
    n.hear(1,
           aodv::Reply{.hops = 1,
                       .destination = NodeId{5},
                       .number = 9,
                       .originator = NodeId{7},
                       .lifetime = 6s},
           2);
    n.forward(7, 2, 5);
    n.link.go();
    n.link.end(n.router, n.link.sent.size() - 1, SendResult::retries);
    CHECK(n.link.drops.empty());
    CHECK(n.sent<aodv::Error>().empty());
    const auto [frame, asked] = n.sent<aodv::Request>().back();
    CHECK(asked.number == std::optional<std::uint32_t>(10));  // raised first
    CHECK(frame.ttl == 5);                                    // 3 hops + 2
    SUBCASE("a repair that finds a longer route is reported as repaired") {
        n.learn(5, 3, 11, 4);
        REQUIRE(n.data().size() == 2);
        CHECK(n.data()[1].next_hop == NodeId{3});
        REQUIRE(n.sent<aodv::Error>().size() == 1);
        CHECK(n.sent<aodv::Error>()[0].second.is_repaired);  // it is longer
    }
    SUBCASE("a repair that finds no route drops the message, and the break is reported") {
        n.wait();
        REQUIRE(n.link.drops.size() == 1);
        CHECK(n.link.drops[0].reason == DropReason::no_route);
        CHECK_FALSE(n.sent<aodv::Error>().back().second.is_repaired);
    }
}

TEST_CASE("aodv 6.13: a node that was switched on again is silent for 15 s") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    n.router.on_switched(n.link, NodeId{0}, false);
    n.router.on_switched(n.link, NodeId{0}, true);
    CHECK_FALSE(n.route(5));
    n.hear(2, request(7, 0));
    n.send(5);
    CHECK(n.link.sent.empty());
    n.wait();
    CHECK(n.link.time == start_of_run + 15s);
    CHECK(n.sent<aodv::Request>().size() == 1);
}

TEST_CASE(
    "aodv: at most 64 messages wait for a route, for 30 s each, and the oldest is dropped first") {
    AodvNode n({.rreq_retries = 10});
    for (int i = 0; i < 66; ++i) n.send(5);
    REQUIRE(n.link.drops.size() == 2);
    CHECK(n.link.drops[0].reason == DropReason::buffer_full);
    while (n.link.time < start_of_run + 30s) n.wait();
    CHECK(n.link.drops.size() == 66);
    CHECK(n.link.drops.back().reason == DropReason::timeout);
}

TEST_CASE("aodv: a message that comes twice is delivered once") {
    AodvNode n;
    const MessageId id = n.link.message_from(NodeId{7}, NodeId{0});
    const Frame frame{
        .message = id, .sender = NodeId{2}, .ttl = 5, .hops = 2, .next_hop = NodeId{0}};
    CHECK(n.link.arrive(n.router, frame, {0})[0].delivered);
    const auto again = n.link.arrive(n.router, frame, {0});
    CHECK_FALSE(again[0].delivered);
    CHECK(again[0].fate == Fate::duplicate);
}

}  // namespace aodv_test
