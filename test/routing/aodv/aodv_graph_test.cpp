// SPDX-License-Identifier: MIT
// AODV on small graphs without radio: packets counted as a model of the RFC's rules counts them
// (line of five, diamond, ring of six, grid of nine), before and after a node on the path vanishes.
#include "routing/aodv.hpp"
#include "routing/aodv/aodv_packets.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <optional>
#include <ostream>
#include <vector>

namespace aodv_graph_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Graph;

namespace {

const std::vector<Graph::Edge> line5{{0, 1}, {1, 2}, {2, 3}, {3, 4}};
const std::vector<Graph::Edge> diamond{{0, 1}, {0, 2}, {1, 3}, {2, 3}};
const std::vector<Graph::Edge> ring6{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}};
const std::vector<Graph::Edge> grid{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8},
                                    {0, 3}, {3, 6}, {1, 4}, {4, 7}, {2, 5}, {5, 8}};

/// Frames by kind.
struct Counts {
    int requests, replies, errors, data;
    friend bool operator==(const Counts&, const Counts&) = default;
    friend Counts operator-(const Counts& a, const Counts& b) {
        return {a.requests - b.requests, a.replies - b.replies, a.errors - b.errors,
                a.data - b.data};
    }
    friend std::ostream& operator<<(std::ostream& to, const Counts& c) {
        return to << c.requests << ' ' << c.replies << ' ' << c.errors << ' ' << c.data;
    }
};
/// Messages by what became of them.
struct Ends {
    int delivered, lost, waiting;
    friend bool operator==(const Ends&, const Ends&) = default;
    friend std::ostream& operator<<(std::ostream& to, const Ends& e) {
        return to << e.delivered << ' ' << e.lost << ' ' << e.waiting;
    }
};

/// 36 messages from node 0, four a second from 1 s on; a node vanishes at 4.9 s.
struct Run {
    Run(std::size_t nodes, const std::vector<Graph::Edge>& edges, std::uint32_t to,
        std::optional<std::uint32_t> vanishes, Aodv aodv)
        : graph(nodes, edges, with_no_jitter(aodv)) {
        for (int i = 0; i < 36; ++i) graph.send(0, to, start_of_run + 1s + i * 250ms);
        graph.run(start_of_run + 4900ms);
        before = counts();
        if (vanishes) graph.isolate(*vanishes);
        graph.run(start_of_run + 12s);
        after = counts() - before;
        for (const auto& each : graph.delivered) {
            CHECK(each.size() <= 1);
            ends.delivered += static_cast<int>(each.size());
            for (const auto& [node, hops] : each) CHECK(node == NodeId{to});
        }
        for (const auto& [code, count] : graph.drops) ends.lost += count;
        ends.waiting = 36 - ends.delivered - ends.lost;
    }
    static Aodv with_no_jitter(Aodv aodv) {
        aodv.jitter = {};
        return aodv;
    }
    Counts counts() {
        return {graph.frames[aodv::request_kind], graph.frames[aodv::reply_kind],
                graph.frames[aodv::error_kind], graph.frames[""]};
    }

    Graph graph;
    Counts before{}, after{};
    Ends ends{};
};

}  // namespace

// A RERR with flag N (6.12) tells that a repaired route is longer; the model leaves it out.
TEST_CASE(
    "aodv on graphs: packet counts equal those of an independent model, also after a node "
    "vanishes") {
    const Aodv rings{}, repair{.local_repair = true}, flat{.rings = false};
    struct Case {
        const char* name;
        std::size_t nodes;
        const std::vector<Graph::Edge>& edges;
        std::uint32_t to;
        std::optional<std::uint32_t> vanishes;
        Aodv aodv;
        Counts before, after;
        Ends ends;
    };
    const std::vector<Case> cases{
        {"line", 5, line5, 4, {}, rings, {8, 4, 0, 64}, {0, 0, 0, 80}, {36, 0, 0}},
        {"line, 3", 5, line5, 4, 3, rings, {8, 4, 0, 64}, {9, 0, 2, 3}, {16, 1, 19}},
        {"line, 3, repair", 5, line5, 4, 3, repair, {8, 4, 0, 64}, {12, 0, 2, 5}, {16, 2, 18}},
        {"line, 3, no rings", 5, line5, 4, 3, flat, {4, 4, 0, 64}, {6, 0, 2, 3}, {16, 1, 19}},
        {"diamond, 1", 4, diamond, 3, 1, rings, {4, 2, 0, 32}, {2, 2, 0, 39}, {35, 1, 0}},
        {"diamond, 1, repair", 4, diamond, 3, 1, repair, {4, 2, 0, 32}, {2, 2, 0, 39}, {35, 1, 0}},
        {"ring, 2", 6, ring6, 3, 2, rings, {6, 3, 0, 48}, {4, 3, 1, 59}, {35, 1, 0}},
        {"ring, 2, repair", 6, ring6, 3, 2, repair, {6, 3, 0, 48}, {4, 4, 1, 63}, {36, 0, 0}},
        {"grid, 5", 9, grid, 8, 5, rings, {15, 4, 0, 64}, {7, 4, 2, 79}, {35, 1, 0}},
        {"grid, 5, repair", 9, grid, 8, 5, repair, {15, 4, 0, 64}, {6, 4, 1, 83}, {36, 0, 0}}};
    for (const Case& each : cases) {
        CAPTURE(each.name);
        const Run run(each.nodes, each.edges, each.to, each.vanishes, each.aodv);
        CHECK(run.before == each.before);
        CHECK(run.after == each.after);
        CHECK(run.ends == each.ends);
    }
}

TEST_CASE("aodv on graphs: with profile ns2, as many packets are sent as in ns-2.35") {
    const Aodv ns2{.profile = AodvProfile::ns2};
    const Run line(5, line5, 4, 3, ns2), cross(4, diamond, 3, 1, ns2), ring(6, ring6, 3, 2, ns2),
        nine(9, grid, 8, 5, ns2);
    CHECK(line.before == Counts{4, 4, 0, 64});
    CHECK(cross.before == Counts{3, 2, 0, 32});
    CHECK(ring.before == Counts{5, 3, 0, 48});
    CHECK(nine.before == Counts{8, 4, 0, 64});
    CHECK(line.after == Counts{18, 0, 2, 3});
    CHECK(cross.after == Counts{2, 2, 1, 39});
    CHECK(ring.after == Counts{4, 3, 1, 59});
    CHECK(nine.after == Counts{7, 4, 2, 79});
    CHECK(line.ends.delivered == 16);
    CHECK(cross.ends.delivered == 35);
    CHECK(ring.ends.delivered == 35);
    CHECK(nine.ends.delivered == 35);
}

TEST_CASE(
    "aodv 6.7: if no frame is lost, every message arrives, also after gaps in the traffic and with "
    "flag D (destination only)") {
    // Gaps in which routes expire but are not forgotten, between random nodes of random graphs.
    int replies_of_neighbours = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto draw = [&](std::uint64_t index, std::size_t below) {
            return static_cast<std::uint32_t>(
                uniform({.seed = seed, .purpose = Purpose::order, .index = index}) *
                static_cast<double>(below));
        };
        const std::size_t nodes = 4 + draw(0, 8);
        std::vector<Graph::Edge> edges;
        for (std::uint32_t i = 1; i < nodes; ++i) edges.push_back({draw(i, i), i});
        for (std::uint32_t k = 0; k < draw(100, nodes); ++k) {
            const std::uint32_t a = draw(200 + k, nodes), b = draw(300 + k, nodes);
            if (a != b) edges.push_back({a, b});
        }
        Graph graph(nodes, edges, Run::with_no_jitter({.destination_only = seed % 2 == 0}));
        graph.seed = seed;
        Time when = start_of_run + 1s;
        for (int i = 0; i < 12; ++i, when += 1s + draw(400 + i, 16'000) * 1ms) {
            const std::uint32_t from = draw(500 + i, nodes), to = draw(600 + i, nodes);
            if (from == to) continue;
            graph.send(from, to, when);
        }
        graph.run(when + 60s);
        CAPTURE(seed);
        for (const auto& each : graph.delivered) CHECK(each.size() == 1);
        CHECK(graph.drops.empty());
        replies_of_neighbours += graph.frames[aodv::reply_kind];
    }
    CHECK(replies_of_neighbours > 1000);
}

TEST_CASE(
    "aodv 6.7: after a gap in the traffic, a search needs one request, whose TTL is the old "
    "route's hops plus 2") {
    Graph line(3, {{0, 1}, {1, 2}}, Run::with_no_jitter({}));
    for (int i = 0; i < 10; ++i) line.send(0, 2, start_of_run + 1s + i * 10s);
    line.run(start_of_run + 120s);
    for (const auto& each : line.delivered) CHECK(each.size() == 1);
    // The first search: TTL 1, then 3. Each later one: TTL 4.
    CHECK(line.frames[aodv::request_kind] == 1 + 2 + 9 * 2);
    CHECK(line.frames[aodv::reply_kind] == 10 * 2);
}

}  // namespace aodv_graph_test
