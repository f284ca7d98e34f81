// SPDX-License-Identifier: MIT
// Scheme "cluster" of the suppression of a flood: clusters by HELLO packets that are made up, and
// what heads and gateways reach on graphs.
#include "routing/suppression/cluster_router.hpp"
#include "test/routing/fake_link_layer.hpp"
#include "test/routing/unit_disc.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cluster_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Graph;
using test::UnitDisc;

namespace {

const Suppression cluster{.scheme = SuppressionScheme::cluster, .delay = 248 * Graph::hop_time};

/// Node 5, which hears HELLOs; its key is 5.
struct Member {
    ClusterRouter router{cluster};
    test::FakeLinkLayer link{10};

    /// Node 5 hears a HELLO of a node, which belongs to the cluster of `head`.
    void hear(std::uint32_t from, std::uint32_t head) {
        const std::string content{0, 0, 0, static_cast<char>(head)};
        const MessageId hello = link.originate({from}, everyone, "SUPPRESSION HELLO", 36, content);
        const auto r =
            link.arrive(router, {.message = hello, .sender = {from}, .ttl = 1, .hops = 1}, {5});
        CHECK(r[0].fate == Fate::arrived);
        CHECK(!r[0].delivered);
        link.release(hello);
    }
    /// Head that node 5 tells in its next HELLO.
    NodeId tells() {
        router.on_timer(link, {5}, 0);
        const Message& message = link.message(link.sent.back().queued.frame.message);
        CHECK(message.kind == "SUPPRESSION HELLO");
        CHECK(message.size == 36);
        CHECK(message.payload.size() == 4);
        CHECK(router.head({5}) == NodeId{static_cast<std::uint8_t>(message.payload[3])});
        return router.head({5});
    }
    bool relays() const { return router.is_relay({5}, link.time); }
};

/// A protocol that a test looks into while a graph runs it.
struct Shared {
    ClusterRouter* router;
    Hops initial_ttl() const { return router->initial_ttl(); }
    void send(LinkLayer& link, NodeId node, MessageId m) { router->send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        router->on_receive(link, frame, receptions);
    }
    void on_start(LinkLayer& link, NodeId node) { router->on_start(link, node); }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        router->on_timer(link, node, tag);
    }
    void on_switched(LinkLayer& link, NodeId node, bool on) { router->on_switched(link, node, on); }
    void forget(MessageId m) { router->forget(m); }
};

/// Heads by the definition: in the order of keys, each node without a head among its neighbours.
std::vector<bool> heads_of(const UnitDisc& net) {
    std::vector<bool> is_head(net.at.size());
    const auto neighbours = net.neighbours();
    for (std::size_t i = 0; i < net.at.size(); ++i) {
        is_head[i] = std::none_of(neighbours[i].begin(), neighbours[i].end(),
                                  [&](std::uint32_t j) { return j < i && is_head[j]; });
    }
    return is_head;
}

/// Time after which the clusters of the graphs below have settled.
constexpr Time settled = start_of_run + 60s;

}  // namespace

TEST_CASE(
    "cluster: a node without neighbours is a cluster head, and later joins a head with a lower "
    "name hash") {
    Member node;
    CHECK(node.relays());  // no cluster yet
    CHECK(node.tells() == NodeId{5});
    CHECK(node.relays());
    node.hear(7, 7);  // a higher key
    CHECK(node.tells() == NodeId{5});
    node.hear(4, 2);  // a member of another cluster
    CHECK(node.tells() == NodeId{5});
    node.hear(3, 3);
    CHECK(node.tells() == NodeId{3});
    node.hear(1, 1);
    CHECK(node.tells() == NodeId{1});
    node.hear(1, 0);  // no head any more
    CHECK(node.tells() == NodeId{3});
}

TEST_CASE("cluster: a member that hears a node of another cluster is a gateway and forwards") {
    Member node;
    node.hear(1, 1);
    node.hear(4, 1);
    CHECK(node.tells() == NodeId{1});
    CHECK(!node.relays());
    node.hear(6, 2);
    CHECK(node.relays());
    node.hear(6, 1);
    CHECK(!node.relays());
}

TEST_CASE("cluster: neighbours that are silent for three HELLO periods are forgotten") {
    Member node;
    node.hear(1, 1);
    node.link.time += 1s;
    node.hear(6, 2);
    CHECK(node.tells() == NodeId{1});
    node.link.time += 2s;
    CHECK(node.tells() == NodeId{1});
    CHECK(node.relays());
    node.link.time += 1ns;
    CHECK(node.tells() == NodeId{5});
    node.hear(1, 1);
    CHECK(node.tells() == NodeId{1});
    CHECK(node.relays());
    node.link.time += 1s;
    CHECK(!node.relays());
}

TEST_CASE("cluster: HELLOs are 0.75 to 1.25 periods apart, and a node that is off sends none") {
    Member node;
    node.link.drawn = 0.25;
    node.router.on_start(node.link, {5});
    CHECK(node.link.timers.back().at == start_of_run + 250ms);
    node.hear(1, 1);
    node.tells();
    CHECK(node.link.timers.back().at == start_of_run + 875ms);
    const std::size_t sent = node.link.sent.size();
    node.link.on[5] = false;
    node.router.on_switched(node.link, {5}, false);
    node.router.on_timer(node.link, {5}, 0);
    CHECK(node.link.timers.size() == 3);
    CHECK(node.link.sent.size() == sent);
    node.link.on[5] = true;
    CHECK(node.tells() == NodeId{5});
}

TEST_CASE("cluster: a gateway forwards a copy after a delay, other members only deliver the copy") {
    for (const bool is_gateway : {true, false}) {
        Member node;
        node.hear(1, 1);
        if (is_gateway) node.hear(6, 2);
        node.tells();
        const MessageId message = node.link.message_from({1});
        const Frame frame{.message = message, .sender = {1}, .ttl = 9, .hops = 1};
        const Reception first = node.link.arrive(node.router, frame, {5})[0];
        CHECK(first.fate == (is_gateway ? Fate::waiting : Fate::arrived));
        CHECK(first.delivered);
        const Reception again = node.link.arrive(node.router, frame, {5})[0];
        CHECK(again.fate == Fate::duplicate);
        CHECK(!again.delivered);
        if (is_gateway) {
            CHECK(node.link.sent.back().at == start_of_run + 1us + 124ms);
            CHECK(node.link.sent.back().queued.frame.ttl == 8);
        }
        CHECK(node.link.sent.size() == (is_gateway ? 2 : 1));  // with the HELLO
    }
}

TEST_CASE("cluster: the key `threshold` with any value, and a HELLO period of 0, are refused") {
    const auto make = [](const Suppression& settings) { return Router(settings); };
    CHECK_THROWS_WITH_AS(make({.scheme = SuppressionScheme::cluster, .threshold = 3}),
                         "suppression: threshold must be left out for scheme \"cluster\", got 3",
                         std::invalid_argument);
    CHECK_THROWS_AS(make({.scheme = SuppressionScheme::cluster, .hello = Duration{0}}),
                    std::invalid_argument);
}

TEST_CASE(
    "cluster on graphs: the right nodes become cluster heads, and all nodes connected to the "
    "source are reached") {
    for (const int k : {1, 3, 5, 7, 9}) {
        double saved = 0;
        constexpr int maps = 5;
        for (std::uint64_t seed = 1; seed <= maps; ++seed) {
            CAPTURE(k);
            CAPTURE(seed);
            const UnitDisc net(100, 500.0 * k, 500, seed);
            ClusterRouter router(cluster);
            Graph graph(net.at.size(), net.edges, Shared{&router});
            graph.seed = seed;
            graph.send(net.source, everyone.value, settled);
            graph.run(settled + 100s);
            const std::vector<bool> heads = heads_of(net);
            for (std::uint32_t i = 0; i < net.at.size(); ++i)
                CHECK((router.head({i}) == NodeId{i}) == heads[i]);
            const auto reached = graph.delivered[0].size();
            CHECK(reached == net.reachable());
            if (reached > 0)
                saved += (static_cast<double>(reached) - graph.frames[""] + 1) /
                         static_cast<double>(reached) / maps;
        }
        if (k == 1) CHECK(saved > 0.1);
    }
}

TEST_CASE("cluster on graphs: if all nodes are neighbours, only the cluster head forwards") {
    std::vector<Graph::Edge> edges;
    for (std::uint32_t i = 0; i < 8; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) edges.emplace_back(i, j);
    }
    Graph graph(8, edges, cluster);
    graph.send(3, everyone.value, settled);
    graph.run(settled + 10s);
    CHECK(graph.delivered[0].size() == 7);
    CHECK(graph.frames[""] == 2);
}

TEST_CASE("cluster on graphs: a cluster head that leaves is replaced") {
    // 1-0-2: node 0 is the head. Without it nodes 1 and 2 meet over node 3.
    Graph graph(4, {{0, 1}, {0, 2}}, cluster);
    graph.at(start_of_run + 20s, [&] {
        graph.isolate(0);
        graph.join(1, 3);
        graph.join(3, 2);
    });
    graph.send(1, everyone.value, start_of_run + 10s);
    graph.send(1, everyone.value, start_of_run + 40s);
    graph.run(start_of_run + 50s);
    CHECK(graph.delivered[0].size() == 2);
    CHECK(graph.delivered[1].size() == 2);
}

}  // namespace cluster_test
