// SPDX-License-Identifier: MIT
// The lossless graph on which protocols are tested, and the fake link layer: by a flood, whose
// deliveries are a breadth-first search.
#include "test/routing/graph.hpp"

#include "routing/flood.hpp"
#include "test/routing/fake_link_layer.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <deque>
#include <map>
#include <vector>

namespace graph_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::FakeLinkLayer;
using test::Graph;

namespace {

const std::vector<Graph::Edge> grid{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8},
                                    {0, 3}, {3, 6}, {1, 4}, {4, 7}, {2, 5}, {5, 8}};

/// Hops from `from` to every node, by a breadth-first search.
std::map<std::uint32_t, int> hops_from(std::uint32_t from) {
    std::map<std::uint32_t, int> hops{{from, 0}};
    for (std::deque<std::uint32_t> todo{from}; !todo.empty(); todo.pop_front()) {
        for (const auto& [a, b] : grid) {
            for (const auto& [here, there] : {std::pair{a, b}, std::pair{b, a}}) {
                if (here == todo.front() && hops.emplace(there, hops[here] + 1).second)
                    todo.push_back(there);
            }
        }
    }
    return hops;
}

/// Sends every message to its destination if that is a neighbour; counts results.
struct Direct {
    static constexpr bool routes_unicasts = true;
    std::map<SendResult, int>* results;

    Hops initial_ttl() const { return 1; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        link.send({.message = message,
                   .sender = node,
                   .ttl = 1,
                   .hops = 1,
                   .next_hop = link.message(message).to},
                  {}, link.now());
    }
    void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
        for (Reception& r : receptions) {
            r.fate = Fate::arrived;
            r.delivered = true;
        }
    }
    void on_sent(LinkLayer&, const QueuedFrame&, SendResult result) { ++(*results)[result]; }
};

}  // namespace

TEST_CASE("graph: a flood reaches every node within its ttl, over the fewest hops") {
    for (const int ttl : {1, 2, 4}) {
        CAPTURE(ttl);
        Graph graph(9, grid, Flood{.ttl = ttl, .jitter = Duration{0}});
        graph.send(0, everyone.value, start_of_run);
        graph.run(start_of_run + 1s);
        std::map<std::uint32_t, int> heard;
        for (const auto& [node, hops] : graph.delivered[0]) heard[node.value] = hops;
        std::map<std::uint32_t, int> expected = hops_from(0);
        std::erase_if(expected, [&](const auto& e) { return e.second == 0 || e.second > ttl; });
        CHECK(heard == expected);
        CHECK(graph.messages_in_use() == 0);
    }
}

TEST_CASE(
    "graph: a unicast over an edge is acknowledged; without an edge, it fails after all retries") {
    std::map<SendResult, int> results;
    Graph graph(3, {{0, 1}, {1, 2}}, Direct{&results});
    graph.send(0, 1, start_of_run);
    graph.send(0, 2, start_of_run);
    graph.run(start_of_run + 1s);
    CHECK(results == std::map<SendResult, int>{{SendResult::acked, 1}, {SendResult::retries, 1}});
    CHECK(graph.delivered[0].size() == 1);
    CHECK(graph.delivered[1].empty());
    graph.cut(0, 1);
    graph.send(0, 1, start_of_run + 2s);
    graph.run(start_of_run + 3s);
    CHECK(results[SendResult::retries] == 2);
}

TEST_CASE(
    "fake link layer: a sent frame is freed, and take_queued returns the queued frames for a next "
    "hop") {
    FakeLinkLayer link(3);
    std::map<SendResult, int> results;
    Direct protocol{&results};
    int forgotten = 0;
    link.on_forgotten = [&](MessageId) { ++forgotten; };
    for (const std::uint32_t to : {1U, 2U, 1U}) {
        const MessageId m = link.message_from(NodeId{0}, NodeId{to});
        protocol.send(link, NodeId{0}, m);
        link.release(m);
    }
    link.end(protocol, 1, SendResult::acked);
    CHECK(results == std::map<SendResult, int>{{SendResult::acked, 1}});
    CHECK(forgotten == 1);
    const auto taken = link.take_queued(NodeId{0}, NodeId{1});
    REQUIRE(taken.size() == 2);
    CHECK(link.take_queued(NodeId{0}, NodeId{1}).empty());
    CHECK(forgotten == 1);
    for (const QueuedFrame& each : taken) link.release(each.frame);
    CHECK(forgotten == 3);
    CHECK(link.messages.size() == 0);
}

}  // namespace graph_test
