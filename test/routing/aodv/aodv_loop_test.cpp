// SPDX-License-Identifier: MIT
// Loop freedom of AODV over random graphs with breaks, joins, losses, delays and restarts: at every
// event, along the next hops of valid routes to a destination, the pair (number, -hops) rises, so
// that no loop can exist; it rises along the way of every message, too, so that none comes to a
// node twice by the same route. Controls: without the rules that AODV needs for it, loops are
// found.
#include "routing/aodv/aodv_router.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace aodv_loop_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Graph;

namespace {

/// An AodvRouter into which the test can look.
struct Watched {
    static constexpr bool routes_unicasts = true;
    std::shared_ptr<AodvRouter> router;

    Hops initial_ttl() const { return router->initial_ttl(); }
    void send(LinkLayer& l, NodeId n, MessageId m) { router->send(l, n, m); }
    void on_receive(LinkLayer& l, const Frame& f, std::span<Reception> r) {
        router->on_receive(l, f, r);
    }
    void on_sent(LinkLayer& l, const QueuedFrame& f, SendResult r) { router->on_sent(l, f, r); }
    void on_timer(LinkLayer& l, NodeId n, std::uint64_t tag) { router->on_timer(l, n, tag); }
    void on_start(LinkLayer& l, NodeId n) { router->on_start(l, n); }
    void on_switched(LinkLayer& l, NodeId n, bool on) { router->on_switched(l, n, on); }
    void forget(MessageId m) { router->forget(m); }
};

/// What was found in runs over random graphs.
struct Findings {
    int events = 0, valid = 0;
    int disorder = 0;  ///< next hops whose (number, -hops) does not rise
    int loops = 0;     ///< next hops that lead back to a node
    int own = 0;       ///< routes of a node to itself
    int revisits = 0;  ///< messages that came to a node twice
    int falls = 0;     ///< hops of messages to a node whose (number, -hops) is not above the last
    int spent = 0;     ///< messages whose TTL was used up
    int delivered = 0, sent = 0;
};

struct Options {
    AodvRules rules;
    bool restarts = true;
    double unnoticed = 0.05;
};

class Watch {
  public:
    Watch(const AodvRouter& router, std::uint32_t nodes, Findings& found)
        : router_(router), nodes_(nodes), found_(found) {}

    void look(Time now) {
        ++found_.events;
        for (std::uint32_t i = 0; i < nodes_; ++i) {
            for (const Route& mine : router_.stored_routes(NodeId{i})) {
                if (!is_valid(mine, now)) continue;
                ++found_.valid;
                found_.own += mine.destination == NodeId{i};
                const Route* next = of(mine.next_hop, mine.destination, now);
                if (!next) continue;
                const bool rises = mine.has_number && next->has_number &&
                                   (is_newer(next->number, mine.number) ||
                                    (next->number == mine.number && next->hops < mine.hops));
                // A neighbour whose number is not known is the destination's.
                const bool is_last = next->next_hop == mine.destination;
                found_.disorder += !rises && !(is_last && next->hops == 1);
                found_.loops += leads_back(NodeId{i}, mine.destination, now);
            }
        }
    }

    /// A message arrives at a node, which may send it on.
    void arrive(const Message& message, NodeId node, Time now) {
        found_.revisits +=
            !visited_[message.uid].insert(node.value).second || node == message.origin;
        const Route* next = node == message.to ? nullptr : of(node, message.to, now);
        if (!next || !next->has_number) return;
        const auto [place, is_first] = ways_.try_emplace(message.uid, *next);
        const Route last = std::exchange(place->second, *next);
        found_.falls += !is_first && !(is_newer(next->number, last.number) ||
                                       (next->number == last.number && next->hops < last.hops));
    }

  private:
    static bool is_valid(const Route& route, Time now) {
        return route.is_valid && route.until > now;
    }
    const Route* of(NodeId node, NodeId destination, Time now) const {
        for (const Route& each : router_.stored_routes(node)) {
            if (each.destination == destination && is_valid(each, now)) return &each;
        }
        return nullptr;
    }
    bool leads_back(NodeId from, NodeId destination, Time now) const {
        NodeId at = from;
        for (std::uint32_t step = 0; step <= nodes_; ++step) {
            const Route* next = at == destination ? nullptr : of(at, destination, now);
            if (!next) return false;
            at = next->next_hop;
        }
        return true;
    }

    const AodvRouter& router_;
    std::uint32_t nodes_;
    Findings& found_;
    // By uid of messages: nodes, and the last node's route.
    std::map<std::uint64_t, std::set<std::uint32_t>> visited_;
    std::map<std::uint64_t, Route> ways_;
};

/// One random graph of 4 to 12 nodes, over 25 s.
void run_graph(std::uint32_t seed, const Options& options, Findings& found) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const std::uint32_t nodes = 4 + below(9);
    std::vector<Graph::Edge> edges;
    for (std::uint32_t a = 0; a < nodes; ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            if (b + 1 == a ? below(10) < 8 : below(nodes) < 2) edges.emplace_back(a, b);
        }
    }
    const auto router = std::make_shared<AodvRouter>(options.rules);
    Graph graph(nodes, edges, Watched{router});
    graph.faults = {.loss = 0.1, .unnoticed = options.unnoticed, .longest = 20ms, .seed = seed};
    Watch watch(*router, nodes, found);
    graph.after_event = [&] { watch.look(graph.now()); };
    graph.on_message_at = [&](const Message& message, NodeId node) {
        watch.arrive(message, node, graph.now());
    };
    graph.on_transmit = [&](const Frame& frame) {
        found.spent += graph.message(frame.message).kind.empty() && frame.ttl == 1;
    };
    constexpr int seconds_long = 25;
    const auto some_time = [&] { return start_of_run + 1ms * below(1000 * seconds_long); };
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
    for (int i = 0; options.restarts && i < 4; ++i) {
        const std::uint32_t node = below(nodes);
        const Time off = some_time();
        graph.at(off, [&graph, node] { graph.switch_node(node, false); });
        graph.at(off + 1ms * below(500), [&graph, node] { graph.switch_node(node, true); });
    }
    graph.run(start_of_run + seconds_long * 1s);
    for (const auto& each : graph.delivered) found.delivered += !each.empty();
}

/// Rules with short lives, so that much happens in a run.
AodvRules short_lived(Aodv aodv = {}) {
    aodv.active_route_timeout = 1500ms;
    aodv.my_route_timeout = 3s;
    aodv.node_traversal_time = 20ms;
    return AodvRules::of(aodv);
}

Findings findings(int graphs, const Options& options, int enough = 1 << 30) {
    Findings found;
    for (int seed = 1; seed <= graphs && found.loops < enough; ++seed) {
        run_graph(static_cast<std::uint32_t>(seed), options, found);
    }
    return found;
}

void check(const Findings& found, bool ways = true) {
    CHECK(found.disorder == 0);
    CHECK(found.loops == 0);
    CHECK(found.own == 0);
    CHECK(found.spent == 0);
    if (ways) CHECK(found.falls == 0);
}

}  // namespace

TEST_CASE("aodv: in 2,000 random graphs, routes have no loop after any event") {
    const Findings found = findings(2000, {.rules = short_lived()});
    check(found);
    CHECK(found.valid > 500'000);
    CHECK(found.delivered > found.sent / 3);
    MESSAGE(found.events, " events, ", found.delivered, " of ", found.sent, " delivered, ",
            found.revisits, " came to a node twice");
}

// A frame that arrived without its sender's notice is repaired though it travels on, so that its
// two copies have two ways: here there are none.
TEST_CASE(
    "aodv: also with local repair, and with profile ns2, routes have no loop after any event") {
    const std::vector<Aodv> variants{{.local_repair = true},
                                     {.profile = AodvProfile::ns2},
                                     {.gratuitous = true},
                                     {.hello = 500ms}};
    for (const Aodv& each : variants) {
        const Findings found = findings(250, {.rules = short_lived(each), .unnoticed = 0});
        check(found);
        CHECK(found.delivered > found.sent / 3);
    }
    // Messages that repairs send another way pass a node again, by a newer route.
    check(findings(100, {.rules = short_lived({.local_repair = true})}, 1 << 30), false);
}

TEST_CASE(
    "aodv: long-lived routes are loop-free only if sequence numbers are kept as long as routes") {
    Aodv aodv{.active_route_timeout = 500ms, .my_route_timeout = 20s, .node_traversal_time = 20ms};
    AodvRules rules = AodvRules::of(aodv);
    check(findings(250, {.rules = rules}));
    rules.delete_period = rules.silence = 5 * rules.active_route_timeout;
    CHECK(findings(2000, {.rules = rules}, 1).loops > 0);
}

TEST_CASE("aodv: routes have no loop while sequence numbers wrap around") {
    AodvRules rules = short_lived();
    rules.first_number = 0xfffffff0;
    const Findings found = findings(200, {.rules = rules});
    check(found);
    CHECK(found.delivered > found.sent / 3);
}

TEST_CASE("aodv: if a rule against loops is left out, loops are found") {
    AodvRules falling = short_lived(), forgetful = short_lived(), loud = short_lived();
    falling.numbers_may_fall = true;
    forgetful.delete_period = {};
    loud.silence = {};
    for (const AodvRules& each : {falling, forgetful, loud}) {
        const Findings found = findings(2000, {.rules = each}, 1);
        CHECK(found.loops > 0);
        CHECK(found.disorder > 0);
    }
}

}  // namespace aodv_loop_test
