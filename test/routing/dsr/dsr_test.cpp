// SPDX-License-Identifier: MIT
// DSR's rules one by one, by receptions that the test makes up: packets, cache, searches. Names
// begin with the section of RFC 4728.
#include "test/routing/dsr/dsr_node.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

namespace dsr_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::DsrNode;
using test::FakeLinkLayer;
using test::Nodes;
using test::Path;
using test::path;
using test::values;

TEST_CASE("dsr 6: packets have exactly the bytes that the RFC defines, and can be decoded again") {
    const auto message = [](const dsr::Packet& packet, std::uint32_t from, std::uint32_t to) {
        return Message{.origin = NodeId{from}, .to = NodeId{to}, .payload = dsr::to_bytes(packet)};
    };
    const Message asked =
        message({.request = dsr::Request{0x0102, NodeId{9}, path({4, 5, 6})}}, 4, 9);
    CHECK(asked.payload == std::string("\x3b\0\0\x10\1\x0e\1\2\0\0\0\x09\0\0\0\5\0\0\0\6", 20));
    const auto request = dsr::packet_of(asked).request.value();
    CHECK(request.id == 0x0102);
    CHECK(request.target == NodeId{9});
    CHECK(values(request.path) == Nodes{4, 5, 6});
    const Message told =
        message({.reply = dsr::Reply{path({4, 5, 6, 9})},
                 .error = dsr::Error{.from = {7}, .to = {4}, .unreachable = {8}, .salvage = 3},
                 .route = path({9, 6, 5, 4})},
                9, 4);
    const std::string reply("\2\x0d\0\0\0\0\5\0\0\0\6\0\0\0\x09", 15);
    const std::string error("\3\x0e\1\3\0\0\0\7\0\0\0\4\0\0\0\x08", 16);
    const std::string route("\x60\x0a\0\2\0\0\0\6\0\0\0\5", 12);
    CHECK(told.payload == std::string("\x3b\0\0\x2b", 4) + reply + error + route);
    const dsr::Packet back = dsr::packet_of(told);
    CHECK(values(back.reply.value().path) == Nodes{4, 5, 6, 9});
    CHECK(values(back.route.value()) == Nodes{9, 6, 5, 4});
    CHECK(back.error.value().unreachable == NodeId{8});
    CHECK(back.error.value().salvage == 3);
    for (std::string broken : {told.payload.substr(1), told.payload + "x", std::string("\x3b"),
                               std::string("\x3b\0\0\4\3\2\1\0", 8), std::string{},
                               std::string("\x3b\0\0\x04\2\x09\0\0", 8)}) {
        Message other = told;
        other.payload = broken;
        const dsr::Packet none = dsr::packet_of(other);
        CHECK_FALSE((none.request || none.reply || none.error || none.route));
    }
    // On air: IP addresses, and the segments left at that hop.
    const std::string air = dsr::on_air(told.payload, {.message = {}, .sender = {}, .hops = 2},
                                        [](NodeId n) { return 0x0a000000 + n.value; });
    CHECK(air.substr(air.size() - 12) == std::string("\x60\x0a\0\1\x0a\0\0\6\x0a\0\0\5", 12));
    CHECK(air.substr(4, 7) == std::string("\2\x0d\0\x0a\0\0\5", 7));
}

TEST_CASE(
    "dsr 6.7, 8.3.6: a message's header has its route, the salvage count and the segments left") {
    const dsr::Path way = path({4, 5, 6, 9});
    CHECK(dsr::message_header(way, 0, 0) ==
          std::string("\x11\0\0\x0c\x60\x0a\0\2\0\0\0\5\0\0\0\6", 16));
    CHECK(dsr::message_header(way, 0, 2) ==
          std::string("\x11\0\0\x0c\x60\x0a\0\0\0\0\0\5\0\0\0\6", 16));
    CHECK(dsr::message_header(path({4, 9}), 0, 0) == std::string("\x11\0\0\4\x60\2\0\0", 8));
    // The node that salvages is the first address, and is visited already.
    const std::string salvaged = dsr::message_header(way, 7, 1);
    CHECK(salvaged.substr(4, 8) == std::string("\x60\x0e\1\xc1\0\0\0\4", 8));
    CHECK(dsr::header_on_air(salvaged, [](NodeId n) { return 0x0a000000 + n.value; }) ==
          std::string("\x11\0\0\x10\x60\x0e\1\xc1\x0a\0\0\4\x0a\0\0\5\x0a\0\0\6", 20));
    // Sizes on air are those of the bytes.
    CHECK(dsr::message_header(way, 0, 0).size() == dsr::fixed_header + dsr::route_option(2));
    CHECK(salvaged.size() == dsr::fixed_header + dsr::route_option(3));
}

TEST_CASE("dsr: packets in traces have the format of ns-2") {
    const auto text = [](const dsr::Packet& packet, std::uint32_t from, std::uint32_t to,
                         PacketStyle style = PacketStyle::brackets) {
        std::string said;
        dsr::describe({.origin = NodeId{from}, .to = NodeId{to}, .payload = dsr::to_bytes(packet)},
                      style, said);
        return said;
    };
    const dsr::Packet request{.request = dsr::Request{2, NodeId{4}, path({0})}};
    CHECK(text(request, 0, 4) == "1 [1 2] [0 2 0 0->0] [0 0 0 0->0]");
    CHECK(text(request, 0, 4, PacketStyle::tags) ==
          "-P dsr -Ph 1 -Pq 1 -Ps 2 -Pp 0 -Pn 2 -Pl 0 -Pe 0->0 -Pw 0 -Pm 0 -Pc 0 -Pb 0->0 ");
    CHECK(text({.reply = dsr::Reply{path({0, 1, 2, 3, 4})}, .route = path({4, 3, 2, 1, 0})}, 4,
               0) == "5 [0 0] [1 0 5 0->4] [0 0 0 0->0]");
    CHECK(text({.error = dsr::Error{.from = {2}, .to = {0}, .unreachable = {3}},
                .route = path({2, 1, 0})},
               2, 0) == "3 [0 0] [0 0 0 0->0] [1 1 0 2->3]");
}

TEST_CASE(
    "dsr 4.1: the cache holds 30 routes from the node's own searches and 64 other routes, and "
    "finds the shortest") {
    dsr::Cache cache;
    using enum dsr::Cache::Origin;
    for (std::uint32_t i = 100; i < 140; ++i) cache.add(path({0, i, i + 100}), own, {});
    for (std::uint32_t i = 300; i < 380; ++i) cache.add(path({0, i, i + 100}), others, {});
    CHECK(cache.own().size() == 30);
    CHECK(cache.others().size() == 64);
    CHECK_FALSE(cache.find(NodeId{209}));  // the oldest ones left
    CHECK(values(cache.find(NodeId{210}).value()) == Nodes{0, 110, 210});
    cache.add(path({0, 379, 479, 480, 481}), others, {});  // in place of its beginning
    CHECK(cache.others().size() == 64);
    cache.add(path({0, 379, 479}), others, {});  // known
    CHECK(cache.others().size() == 64);
    cache.add(path({0, 139, 481}), own, {});
    CHECK(values(cache.find(NodeId{481}).value()) == Nodes{0, 139, 481});
    cache.remove_link(NodeId{139}, NodeId{481});
    cache.remove_link(NodeId{479}, NodeId{480});
    CHECK_FALSE(cache.find(NodeId{480}));
    CHECK(values(cache.find(NodeId{479}).value()) == Nodes{0, 379, 479});
    CHECK(values(cache.find(NodeId{139}).value()) == Nodes{0, 139});
}

TEST_CASE(
    "dsr 8.1.3, 8.1.5: a message carries its whole route, and has the same size on each hop") {
    DsrNode n;
    n.learn(path({0, 1, 2, 3}));
    n.send(3);
    // The fake's messages have no size: IP, fixed header, and a route of two addresses.
    CHECK(n.data().back().bytes == 20 + 4 + 4 + 4 * 2);
    CHECK(n.data().back().next_hop == NodeId{1});
    CHECK(n.data().back().ttl == 32);
    CHECK(n.route_on_air(n.data().back()) == "1 2, salvage 0, left 2");
    CHECK(n.arrive().fate == Fate::waiting);
    CHECK(n.route_on_air(n.data().back()) == "1 2, salvage 0, left 1");
    CHECK(n.arrive().fate == Fate::waiting);
    CHECK(n.route_on_air(n.data().back()) == "1 2, salvage 0, left 0");
    CHECK(n.data().back().bytes == 36);
    CHECK(n.data().back().sender == NodeId{2});
    CHECK(n.data().back().next_hop == NodeId{3});
    CHECK(n.data().back().ttl == 30);
    const Reception last = n.arrive();
    CHECK(last.delivered);
    CHECK(n.route(0, 3) == Nodes{2, 1, 0});  // the target knows the way back
    const auto again = n.link.arrive(n.router, n.link.sent.back().queued.frame, {3});
    CHECK_FALSE(again[0].delivered);
    CHECK(again[0].fate == Fate::duplicate);
    n.learn(path({0, 5}));
    n.send(5);
    CHECK(n.data().back().bytes == 28);  // a route without addresses
}

TEST_CASE(
    "dsr 8.2.1: the first request reaches only neighbours; 16 more follow at growing intervals") {
    DsrNode n;
    n.send(5);
    std::vector<int> ttls{n.sent(dsr::request_kind).back().first.ttl};
    std::vector<double> waits;
    while (n.sent(dsr::request_kind).size() < 17) {
        const Time before = n.link.time;
        const std::size_t asked = n.sent(dsr::request_kind).size();
        while (n.sent(dsr::request_kind).size() == asked) {
            n.send(5);  // as the others leave after 30 s
            n.wait();
        }
        waits.push_back(seconds(n.link.time - before));
        ttls.push_back(n.sent(dsr::request_kind).back().first.ttl);
    }
    CHECK(std::vector<int>(ttls.begin(), ttls.begin() + 3) == std::vector<int>{1, 32, 32});
    CHECK(waits ==
          std::vector<double>{0.03, 0.5, 1, 2, 4, 8, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10});
    const auto is_lost = [&] {
        return std::any_of(n.link.drops.begin(), n.link.drops.end(),
                           [](const auto& d) { return d.reason == DropReason::no_route; });
    };
    n.send(5);
    CHECK_FALSE(is_lost());
    while (!is_lost()) n.wait();
    CHECK(n.sent(dsr::request_kind).size() == 17);
    CHECK(n.sent(dsr::request_kind)[3].second.request.value().id == 4);
    n.send(5);  // a new search
    CHECK(n.sent(dsr::request_kind).back().first.ttl == 1);
}

// Each message waits alone, and is dropped after 30 s without an answer.
TEST_CASE(
    "dsr 4.3: after a failed search, later searches for the same node wait longer between "
    "requests") {
    DsrNode n;
    for (int message = 0; message < 6; ++message) {
        const std::size_t asked = n.sent(dsr::request_kind).size();
        const Time begin = n.link.time;
        n.send(5);
        n.wait();
        n.wait();
        REQUIRE(n.sent(dsr::request_kind).size() >= asked + 2);
        CHECK(n.sent(dsr::request_kind)[asked].first.ttl == 1);
        CHECK(n.sent(dsr::request_kind)[asked + 1].first.ttl == 32);
        while (n.link.drops.size() == static_cast<std::size_t>(message)) n.wait();
        CHECK(n.link.time == begin + 30s);
        n.link.time = begin + 100s;
        const std::size_t requests = n.sent(dsr::request_kind).size() - asked;
        CHECK(
            requests ==
            (message == 0 ? 8U : 4U));  // 0, 0.03, 0.53 ... 15.53, 25.53 s; 0, 0.03, 10.03, 20.03 s
        CHECK(n.link.drops.back().reason == DropReason::timeout);
    }
    n.learn(path({0, 4, 5}));  // an answer ends the search
    CHECK(n.link.drops.size() == 6);
}

TEST_CASE(
    "dsr 8.2.2: the target answers every copy of a request, along the path that the copy took") {
    DsrNode n;
    CHECK(n.request(path({7, 3}), 0) == Fate::arrived);
    CHECK(n.request(path({7, 4, 2}), 0) == Fate::arrived);
    const auto replies = n.sent(dsr::reply_kind);
    REQUIRE(replies.size() == 2);
    CHECK(values(replies[0].second.reply.value().path) == Nodes{7, 3, 0});
    CHECK(values(replies[1].second.reply.value().path) == Nodes{7, 4, 2, 0});
    CHECK(values(replies[1].second.route.value()) == Nodes{0, 2, 4, 7});
    CHECK(replies[1].first.next_hop == NodeId{2});
    const Message& message = n.link.message(replies[1].first.message);
    CHECK(message.size == 20 + 4 + (3 + 4 * 3) + (4 + 4 * 2));
    CHECK(message.to == NodeId{7});
    CHECK(n.link.sent[0].at == n.link.time + 5ms + 1us);  // jitter of 10 ms, half of it drawn
    CHECK(n.route(7) == Nodes{3, 7});
}

TEST_CASE(
    "dsr 8.2.2: a request is forwarded once, within its hop limit, with the node's address added") {
    DsrNode n;
    CHECK(n.request(path({7, 3}), 5) == Fate::waiting);
    const auto [frame, packet] = n.sent(dsr::request_kind).back();
    CHECK(values(packet.request.value().path) == Nodes{7, 3, 0});
    CHECK(frame.ttl == 9);
    CHECK(n.link.message(frame.message).origin == NodeId{7});
    CHECK(n.link.message(frame.message).to == NodeId{5});
    CHECK(n.link.message(frame.message).size == 20 + 4 + 8 + 4 * 2);
    CHECK(n.link.sent.back().at == n.link.time + 5ms + 1us);
    CHECK(n.request(path({7, 4}), 5) == Fate::duplicate);        // known
    CHECK(n.request(path({7, 0, 4}), 5, 2) == Fate::duplicate);  // listed
    CHECK(n.request(path({0, 4}), 5, 9) == Fate::duplicate);     // its own
    CHECK(n.request(path({7, 4}), 5, 3, 1) == Fate::ttl);        // not beyond the neighbours
    CHECK(n.request(path({7, 4}), 5, 2) == Fate::waiting);       // late, but new
    CHECK(n.request(path({8, 4}), 5, 0xffff) == Fate::waiting);
    CHECK(n.request(path({8, 4}), 5, 0) == Fate::waiting);  // 16 bits wrap around
    CHECK(n.request(path({8, 4}), 5, 0xffff) == Fate::duplicate);
    CHECK(n.sent(dsr::request_kind).size() == 4);
}

TEST_CASE(
    "dsr 8.2.3: a node replies with a known route, unless a node would occur in the route twice") {
    DsrNode n;
    n.learn(path({0, 1, 2, 5}));
    CHECK(n.request(path({7, 2}), 5) == Fate::waiting);  // 2 would come twice
    CHECK(n.sent(dsr::reply_kind).empty());
    CHECK(n.request(path({7, 3}), 5, 2, 1) == Fate::arrived);  // also at the hop limit
    const auto [frame, packet] = n.sent(dsr::reply_kind).back();
    CHECK(values(packet.reply.value().path) == Nodes{7, 3, 0, 1, 2, 5});
    CHECK(values(packet.route.value()) == Nodes{0, 3, 7});
    CHECK(n.sent(dsr::request_kind).size() == 1);
    CHECK(n.request(path({7, 4}), 5, 2) == Fate::duplicate);  // one answer to each request
}

TEST_CASE(
    "dsr 8.2.6: a reply ends the search, and the nodes that forward it learn routes to both ends") {
    DsrNode n;
    n.send(5);
    n.send(5);
    n.wait();
    CHECK(n.reply(path({0, 3, 5}), path({5, 3, 0}), 1) == Fate::arrived);
    CHECK(n.data().size() == 2);
    CHECK(n.data()[0].next_hop == NodeId{3});
    const std::size_t asked = n.sent(dsr::request_kind).size();
    n.wait();
    CHECK(n.sent(dsr::request_kind).size() == asked);
    n.error({.from = {3}, .to = {0}, .unreachable = {5}}, path({3, 0}), 0);
    n.send(5);  // from the start
    CHECK(n.sent(dsr::request_kind).back().first.ttl == 1);
    CHECK(n.reply(path({7, 2, 0, 6, 8}), path({8, 6, 0, 2, 7}), 1) == Fate::waiting);
    CHECK(n.link.sent.back().queued.frame.next_hop == NodeId{2});
    CHECK(n.route(8) == Nodes{6, 8});
    CHECK(n.route(7) == Nodes{2, 7});
}

TEST_CASE(
    "dsr: a route has at most sixteen nodes, and messages to nodes further away are dropped") {
    DsrNode n;
    const Path fourteen = path({20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33});
    Path fifteen = fourteen;
    fifteen.add(NodeId{34});
    CHECK(n.request(fourteen, 5) == Fate::waiting);    // node 0 is the fifteenth
    CHECK(n.request(fifteen, 5, 2) == Fate::ttl);      // no room for node 5
    CHECK(n.request(fifteen, 0, 3) == Fate::arrived);  // node 0 is the sixteenth
    CHECK(n.sent(dsr::reply_kind).size() == 1);
    CHECK(n.router.notice().empty());
    n.send(5, 20);
    n.send(6, 20);
    while (n.link.time < start_of_run + 30s) n.wait();
    REQUIRE(n.link.drops.size() == 2);
    CHECK(n.link.drops[0].reason == DropReason::no_route);  // too far
    CHECK(n.link.drops[1].reason == DropReason::timeout);   // not heard of
    CHECK(n.router.pairs_too_far() == 1);
    CHECK(n.router.notice() ==
          "dsr: messages between 1 pair of robots were lost, because a route request passed 16 "
          "robots without finding the destination; a route of dsr has at most 16 robots");
}

TEST_CASE(
    "dsr 4.2: at most 64 messages wait for a route, for 30 s each, and the oldest is dropped "
    "first") {
    DsrNode n;
    for (int i = 0; i < 66; ++i) n.send(5);
    REQUIRE(n.link.drops.size() == 2);
    CHECK(n.link.drops[0].reason == DropReason::buffer_full);
    while (n.link.time < start_of_run + 30s) n.wait();
    CHECK(n.link.drops.size() == 66);
    CHECK(n.link.drops.back().reason == DropReason::timeout);
}

TEST_CASE("dsr: a node that was off starts without routes, but continues its request ids") {
    DsrNode n;
    n.learn(path({0, 4, 5}));
    n.send(6);
    n.router.on_switched(n.link, NodeId{0}, false);
    REQUIRE(n.link.drops.size() == 1);
    CHECK(n.link.drops[0].reason == DropReason::off);
    n.router.on_switched(n.link, NodeId{0}, true);
    CHECK(n.route(5).empty());
    n.send(6);
    CHECK(n.sent(dsr::request_kind).back().second.request.value().id == 2);
}

}  // namespace dsr_test
