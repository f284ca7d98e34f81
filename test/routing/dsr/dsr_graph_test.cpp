// SPDX-License-Identifier: MIT
// DSR on small graphs without radio: packets counted as ns-2.35 sends them (line of five, diamond,
// ring of six, grid of nine), before and after a node on the path vanishes; and what must hold on
// random graphs with broken links, losses and restarts.
#include "routing/dsr/dsr_router.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <ostream>
#include <random>
#include <span>
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

TEST_CASE("dsr on graphs: packet counts equal those counted by hand, also after a node vanishes") {
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
            const Run run(each.nodes, each.edges, each.to, each.vanishes,
                          {.promiscuous = promiscuous});
            const bool salvages = promiscuous && each.nodes == 9;  // node 2 overheard 1-4-7-8
            CHECK(run.before == each.before);
            CHECK(run.after == (salvages ? Counts{0, 0, 2, 83} : each.after));
            CHECK(run.ends == (salvages ? Ends{36, 0, 0} : each.ends));
        }
    }
}

namespace {

/// What was found in runs over random graphs.
struct Findings {
    int sent = 0, delivered = 0, dropped = 0;
    int frames = 0;
    int salvaged = 0, most_salvaged = 0;
    int revisits = 0;   ///< routes with a node twice
    int misplaced = 0;  ///< frames that are not where their route has them
    int left = 0;       ///< messages that the router keeps at the end
    int headers = 0;    ///< source routes that are not forgotten at the end
};

/// A DsrRouter that looks at the messages which it receives.
struct Watched {
    static constexpr bool routes_unicasts = true, overhears = true;
    DsrRouter router;
    Findings* found;
    int headers = 0;

    Hops initial_ttl() const { return router.initial_ttl(); }
    void send(LinkLayer& l, NodeId n, MessageId m) { router.send(l, n, m); }
    void on_receive(LinkLayer& l, const Frame& f, std::span<Reception> r) {
        if (f.header != 0 && r[0].node == f.next_hop) look(f);
        router.on_receive(l, f, r);
    }
    void on_sent(LinkLayer& l, const QueuedFrame& f, SendResult r) { router.on_sent(l, f, r); }
    void on_timer(LinkLayer& l, NodeId n, std::uint64_t tag) { router.on_timer(l, n, tag); }
    void on_switched(LinkLayer& l, NodeId n, bool on) { router.on_switched(l, n, on); }
    void forget(MessageId m) { router.forget(m); }
    void forget_header(std::uint32_t header) { router.forget_header(header); }
    bool keeps(MessageId m) const { return router.keeps(m); }

    void look(const Frame& frame) {
        const auto& [path, salvage, first_hops, is_read] = router.header(frame);
        ++found->frames;
        found->salvaged += salvage > 0;
        found->most_salvaged = std::max<int>(found->most_salvaged, salvage);
        const auto place = static_cast<std::size_t>(frame.hops - first_hops);
        found->misplaced += place + 1 >= path.size() || path[place] != frame.sender ||
                            path[place + 1] != frame.next_hop;
        for (std::size_t i = 0; i < path.size(); ++i) found->revisits += path.place(path[i]) != i;
    }
};

/// One random graph of 4 to 20 nodes, over 25 s with breaks, losses and restarts, and over the time
/// that messages may wait.
void run_graph(std::uint32_t seed, const Dsr& dsr, double unnoticed, Findings& found) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const std::uint32_t nodes = 4 + below(17);
    std::vector<Graph::Edge> edges;
    for (std::uint32_t a = 0; a < nodes; ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            if (b + 1 == a ? below(10) < 8 : below(nodes) < 2) edges.emplace_back(a, b);
        }
    }
    Graph graph(nodes, edges, Watched{DsrRouter(dsr), &found});
    graph.faults = {.loss = 0.1, .unnoticed = unnoticed, .longest = 20ms, .seed = seed};
    const auto some_time = [&] { return start_of_run + 1ms * below(25'000); };
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t from = below(nodes), to = (from + 1 + below(nodes - 1)) % nodes;
        for (int k = 0; k < 40; ++k) graph.send(from, to, some_time());
        found.sent += 40;
    }
    for (int i = 0; i < 40; ++i) {
        const std::uint32_t a = below(nodes), b = (a + 1 + below(nodes - 1)) % nodes;
        graph.at(some_time(), [&graph, a, b] { graph.cut(a, b); });
        graph.at(some_time(), [&graph, a, b] { graph.join(a, b); });
    }
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t node = below(nodes);
        const Time off = some_time();
        graph.at(off, [&graph, node] { graph.switch_node(node, false); });
        graph.at(off + 1ms * below(500), [&graph, node] { graph.switch_node(node, true); });
    }
    graph.run(start_of_run + 70s);
    for (const auto& each : graph.delivered) {
        CHECK(each.size() <= 1);
        found.delivered += !each.empty();
    }
    for (const auto& [code, count] : graph.drops) found.dropped += count;
    found.left += static_cast<int>(graph.messages_in_use());
    found.headers += static_cast<int>(graph.headers_in_use());
}

}  // namespace

TEST_CASE(
    "dsr on random graphs: routes visit no node twice, and every message is delivered or recorded "
    "as dropped") {
    for (const DsrProfile profile : {DsrProfile::rfc, DsrProfile::ns2}) {
        CAPTURE(static_cast<int>(profile));
        Findings exact, found;
        for (std::uint32_t seed = 1; seed <= 200; ++seed) {
            run_graph(seed, {.profile = profile}, 0, exact);
            run_graph(seed, {.profile = profile}, 0.05, found);
        }
        CHECK(exact.delivered + exact.dropped == exact.sent);
        CHECK(exact.delivered > exact.sent / 3);
        // A message of which the sender does not notice that it arrived goes on twice.
        CHECK(found.delivered + found.dropped >= found.sent);
        for (const Findings& each : {exact, found}) {
            CHECK(each.revisits == 0);
            CHECK(each.misplaced == 0);
            CHECK(each.salvaged > 100);
            CHECK(each.most_salvaged <= 15);
            CHECK(each.left == 0);
            CHECK(each.headers == 0);
            CHECK(each.frames < 10 * each.sent);  // nothing is endless
        }
        MESSAGE(exact.delivered, " and ", found.delivered, " of ", found.sent, " delivered, ",
                found.salvaged, " of ", found.frames, " hops after salvaging, at most ",
                found.most_salvaged, " times");
    }
}

}  // namespace dsr_graph_test
