// SPDX-License-Identifier: MIT
// DSR on small graphs without radio: packets counted as ns-2.35 sends them (line of five, diamond,
// ring of six, grid of nine), before and after a node on the path vanishes; and what must hold on
// random graphs with broken links, losses and restarts.
#include "routing/dsr.hpp"
#include "routing/dsr_packets.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <optional>
#include <ostream>
#include <vector>

namespace dsr_graph_test {
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
        std::optional<std::uint32_t> vanishes, Dsr dsr)
        : graph(nodes, edges, with_no_jitter(dsr)) {
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
    static Dsr with_no_jitter(Dsr dsr) {
        dsr.jitter = {};
        return dsr;
    }
    Counts counts() {
        return {graph.frames[dsr::request_kind], graph.frames[dsr::reply_kind],
                graph.frames[dsr::error_kind], graph.frames[""]};
    }

    Graph graph;
    Counts before{}, after{};
    Ends ends{};
};

}  // namespace

TEST_CASE("dsr on graphs: requests, replies and errors before and after a break") {
    struct Case {
        const char* name;
        std::size_t nodes;
        const std::vector<Graph::Edge>& edges;
        std::uint32_t to;
        std::optional<std::uint32_t> vanishes;
        Counts before, after;
        Ends ends;
    };
    // By hand: a search is one request to the neighbours, then one from every node but the target;
    // the target answers each copy along its own way. After the break of the line node 0 asks at
    // 5.25, 5.28, 5.78, 6.78 and 8.78 s, and nodes 1 and 2 pass the last four on. Elsewhere the
    // second route is known, so that no search is needed.
    const std::vector<Case> cases{
        {"line", 5, line5, 4, {}, {5, 4, 0, 64}, {0, 0, 0, 80}, {36, 0, 0}},
        {"line, 3", 5, line5, 4, 3, {5, 4, 0, 64}, {13, 0, 2, 3}, {16, 1, 19}},
        {"diamond, 1", 4, diamond, 3, 1, {4, 4, 0, 32}, {0, 0, 0, 41}, {36, 0, 0}},
        {"ring, 2", 6, ring6, 3, 2, {6, 6, 0, 48}, {0, 0, 1, 59}, {35, 1, 0}},
        {"grid, 5", 9, grid, 8, 5, {9, 8, 0, 64}, {0, 0, 2, 79}, {35, 1, 0}}};
    for (const bool promiscuous : {false, true}) {
        CAPTURE(promiscuous);
        for (const Case& each : cases) {
            CAPTURE(each.name);
            const Run run(each.nodes, each.edges, each.to, each.vanishes, {.promiscuous = promiscuous});
            const bool salvages = promiscuous && each.nodes == 9;  // node 2 overheard 1-4-7-8
            CHECK(run.before == each.before);
            CHECK(run.after == (salvages ? Counts{0, 0, 2, 83} : each.after));
            CHECK(run.ends == (salvages ? Ends{36, 0, 0} : each.ends));
        }
    }
}

}  // namespace dsr_graph_test
