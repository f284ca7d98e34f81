// SPDX-License-Identifier: MIT
// The managed flood: its rules M1 to M6 one by one by receptions that are made up, and floods on
// small graphs.
#include "routing/managed_router.hpp"
#include "test/routing/fake_link_layer.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace managed_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Graph;
using Stage = test::FakeLinkLayer::Stage;

namespace {

constexpr Duration slot = 28ms;

/// Node 1 in a role, which hears copies of one message of node 0.
struct Relay {
    ManagedRouter router{Managed{.hop_limit = 5, .slot = slot}};
    test::FakeLinkLayer link{4};
    MessageId message = link.message_from({0});

    explicit Relay(std::string_view role = "") {
        link.roles = {"", role};
        link.noise = Dbm{-100};
    }
    /// Node 1 hears a copy with this hop limit, of hop_start 5, at this ratio to the noise.
    Reception hear(int hop_limit, Db snr = 10_dB) {
        link.received_power = link.noise + snr;
        const auto ttl = static_cast<Hops>(hop_limit + 1), hops = static_cast<Hops>(6 - hop_limit);
        const NodeId from{hops == 1 ? 0U : 2U};
        return link.arrive(router, {.message = message, .sender = from, .ttl = ttl, .hops = hops},
                           {1})[0];
    }
    /// Frames that wait for their send time.
    std::vector<test::FakeLinkLayer::Sending> queued() const {
        std::vector<test::FakeLinkLayer::Sending> out;
        for (const auto& each : link.sent) {
            if (each.stage == Stage::waiting) out.push_back(each);
        }
        return out;
    }
    /// Only queued copy.
    QueuedFrame copy() const {
        REQUIRE(queued().size() == 1);
        return queued()[0].queued;
    }
    /// Slots until the only queued copy is sent.
    std::int64_t slots() const {
        REQUIRE(queued().size() == 1);
        const Duration wait = queued()[0].at - link.time - least_reaction;
        CHECK(wait % slot == Duration{0});
        return wait / slot;
    }
};

}  // namespace

TEST_CASE(
    "managed flood, rule M1: if the first copy has hops left, it is queued with a hop limit "
    "smaller by one") {
    for (const char* role : {"", "client", "router", "router_late"}) {
        Relay node(role);
        const Reception r = node.hear(3);
        CHECK(r.fate == Fate::waiting);
        CHECK(r.delivered);
        const Frame copy = node.copy().frame;
        CHECK(copy.sender == NodeId{1});
        CHECK(copy.ttl - 1 == 2);
        CHECK(copy.hops == 4);
    }
}

TEST_CASE(
    "managed flood, rule M1: a copy with hop limit 0 is delivered but not relayed; a `mute` node "
    "relays nothing") {
    Relay last;
    const Reception at_the_end = last.hear(0);
    CHECK(at_the_end.fate == Fate::ttl);
    CHECK(at_the_end.delivered);
    Relay mute("mute");
    const Reception r = mute.hear(3);
    CHECK(r.fate == Fate::arrived);
    CHECK(r.delivered);
    for (const int hop_limit : {4, 5}) CHECK(mute.hear(hop_limit).fate == Fate::duplicate);
    CHECK(last.link.sent.empty());
    CHECK(mute.link.sent.empty());
}

TEST_CASE(
    "managed flood, rule M1: a source sends its message once, without delay, with the full hop "
    "limit") {
    Relay node;
    node.router.send(node.link, {1}, node.message);
    REQUIRE(node.link.sent.size() == 1);
    CHECK(node.link.sent[0].at == node.link.time);
    CHECK(node.link.sent[0].queued.frame.ttl - 1 == 5);
    CHECK(node.link.sent[0].queued.frame.hops == 1);
    for (const int hop_limit : {4, 5}) {
        const Reception echo = node.hear(hop_limit);
        CHECK(echo.fate == Fate::duplicate);
        CHECK(!echo.delivered);
    }
    CHECK(node.link.sent.size() == 1);
}

TEST_CASE(
    "managed flood, rule M2: an SNR of -20 to 10 dB gives a contention window (CW) of 3 to 8") {
    const std::vector<std::pair<double, int>> windows{
        {-40, 3},  {-20, 3}, {-15, 3},  {-14.5, 4},       {-14, 4}, {-8.1, 5},
        {-7.5, 5}, {-2, 6},  {-0.9, 6}, {0, 6},           {3.9, 6}, {4, 7},
        {9.9, 7},  {10, 8},  {60, 8},   {std::nan(""), 3}};
    for (const auto& each : windows) {
        CAPTURE(each.first);
        CHECK(ManagedRouter::contention_window(Db{each.first}) == each.second);
    }
}

TEST_CASE(
    "managed flood, rule M2: routers wait 0 to 2 CW - 1 slots, other roles 16 to 16 + 2^CW - 1 "
    "slots") {
    const auto slots = [](const char* role, double drawn, Db snr) {
        Relay node(role);
        node.link.drawn = drawn;
        node.hear(3, snr);
        return node.slots();
    };
    constexpr double least = 1e-9, most = 1 - 1e-9;
    CHECK(slots("router", least, 10_dB) == 0);
    CHECK(slots("router", most, 10_dB) == 15);
    CHECK(slots("router", 0.5, 10_dB) == 8);
    CHECK(slots("router", most, -20_dB) == 5);
    for (const char* role : {"", "client", "router_late"}) {
        CHECK(slots(role, least, 10_dB) == 16);
        CHECK(slots(role, most, 10_dB) == 16 + 255);
        CHECK(slots(role, 0.5, 10_dB) == 16 + 128);
        CHECK(slots(role, most, -20_dB) == 16 + 7);
        CHECK(slots(role, most, -8_dB) == 16 + 31);
    }
}

TEST_CASE(
    "managed flood, rule M4: if a client hears a duplicate while its copy is queued, the copy is "
    "cancelled") {
    for (const char* role : {"", "client"}) {
        Relay node(role);
        node.hear(3);
        const Reception again = node.hear(3);
        CHECK(again.fate == Fate::duplicate);
        CHECK(!again.delivered);
        CHECK(node.queued().empty());
        CHECK(node.hear(2).fate == Fate::duplicate);
        CHECK(node.link.sent.size() == 1);
        CHECK(node.link.drops.empty());
    }
}

TEST_CASE("managed flood, rule M4: a router relays a message even if it hears a duplicate") {
    Relay node("router");
    node.hear(3);
    const auto slots = node.slots();
    node.hear(3);
    CHECK(node.slots() == slots);
}

TEST_CASE(
    "managed flood, rule M4: a `router_late` that hears a duplicate waits until the slots of all "
    "others are over") {
    Relay node("router_late");
    node.link.drawn = 0.1;
    node.hear(3, -8_dB);
    CHECK(node.slots() == 16 + 3);
    node.link.time += 2 * slot;
    node.hear(2, 10_dB);
    CHECK(node.slots() == 16 + 32);  // of its own copy's window
    CHECK(node.copy().frame.ttl - 1 == 2);
    CHECK(node.copy().heard_from == NodeId{2});
    node.link.time += slot;
    node.hear(2);
    CHECK(node.slots() == 16 + 31);
}

TEST_CASE(
    "managed flood, rule M4: duplicates that a node hears after its own send time have no effect") {
    for (const char* role : {"", "router", "router_late"}) {
        Relay node(role);
        node.hear(3);
        node.link.go();
        for (const int hop_limit : {3, 2, 4}) CHECK(node.hear(hop_limit).fate == Fate::duplicate);
        REQUIRE(node.link.sent.size() == 1);
        CHECK(node.link.sent[0].stage == Stage::queued);
    }
}

TEST_CASE(
    "managed flood, rule M4: after a copy was sent, a duplicate does not cancel a later frame with "
    "the same handle") {
    Relay node;
    node.hear(3);
    node.link.sent[0].queued.frame.sender = NodeId{3};
    node.hear(3);
    CHECK(node.link.sent[0].stage == Stage::waiting);
}

TEST_CASE(
    "managed flood, rule M5: a duplicate with a higher hop limit replaces the queued copy, in any "
    "role") {
    for (const char* role : {"", "router", "router_late"}) {
        Relay node(role);
        node.hear(1, -20_dB);
        CHECK(node.copy().frame.ttl - 1 == 0);
        const Reception upgrade = node.hear(2, 10_dB);
        CHECK(upgrade.fate == Fate::waiting);
        CHECK(!upgrade.delivered);
        CHECK(node.slots() == (role == std::string_view{"router"} ? 8 : 16 + 128));  // drawn anew
        CHECK(node.copy().frame.ttl - 1 == 1);
        CHECK(node.copy().frame.hops == 5);
    }
}

TEST_CASE(
    "managed flood, rule M5: if a duplicate replaces the queued copy, the delay is drawn anew") {
    Relay node;
    node.link.drawn_at = {{0, 0.25}, {1, 0.75}};
    node.hear(1);
    CHECK(node.slots() == 16 + 64);
    node.hear(2);
    CHECK(node.slots() == 16 + 192);
}

TEST_CASE(
    "managed flood, rule M5: if no copy is queued, a duplicate with a higher hop limit has no "
    "effect") {
    Relay ended;
    ended.hear(0);
    CHECK(ended.hear(1).fate == Fate::duplicate);
    CHECK(ended.link.sent.empty());
    Relay cancelled;
    cancelled.hear(1);
    cancelled.hear(1);
    CHECK(cancelled.hear(2).fate == Fate::duplicate);
    CHECK(cancelled.queued().empty());
}

TEST_CASE(
    "managed flood, rule M6: if a source repeats a message and no copy is queued, it is relayed "
    "again") {
    Relay node;
    node.link.drawn_at = {{0, 0.25}, {1, 0.75}};
    CHECK(node.hear(5).delivered);
    node.hear(4);
    CHECK(node.queued().empty());
    const Reception again = node.hear(5);
    CHECK(again.fate == Fate::waiting);
    CHECK(!again.delivered);
    CHECK(node.slots() == 16 + 192);
    CHECK(node.hear(5).fate == Fate::duplicate);  // its copy is queued, and stays
    CHECK(node.slots() == 16 + 192);
    CHECK(node.copy().frame.ttl - 1 == 4);
}

TEST_CASE("managed flood: a hop limit outside of 1 to 7 and a negative slot duration are refused") {
    for (const int hop_limit : {0, 8, -1}) {
        CHECK_THROWS_AS(ManagedRouter(Managed{.hop_limit = hop_limit}), std::invalid_argument);
    }
    CHECK_NOTHROW(ManagedRouter(Managed{.hop_limit = 7}));
    CHECK_THROWS_AS(ManagedRouter(Managed{.slot = Duration{-1}}), std::invalid_argument);
    CHECK(Router{Managed{}}.traits().wants_levels);
    CHECK(Router{Managed{}}.traits().roles.size() == 4);
}

namespace {

struct Flooded {
    int transmissions;
    std::map<std::uint32_t, int> hops;  ///< of the nodes reached
    friend bool operator==(const Flooded&, const Flooded&) = default;
};

/// Roles of nodes and ratios to the noise, of a flood from node 0.
struct Options {
    std::vector<std::string_view> roles = {};
    std::function<Db(NodeId, NodeId)> snr = {};
    int hop_limit = 3;
    std::uint64_t seed = 1;
};

Flooded flooded(std::size_t nodes, const std::vector<Graph::Edge>& edges, Options options = {}) {
    Graph graph(nodes, edges, Managed{.hop_limit = options.hop_limit, .slot = slot});
    graph.roles = options.roles;
    graph.snr_between = options.snr;
    graph.seed = options.seed;
    graph.send(0, everyone.value, start_of_run);
    graph.run(start_of_run + 1000s);
    CHECK(graph.messages_in_use() == 0);
    Flooded out{graph.frames[""], {}};
    for (const auto& [node, hops] : graph.delivered[0]) out.hops[node.value] = hops;
    return out;
}

std::vector<Graph::Edge> line(std::uint32_t nodes) {
    std::vector<Graph::Edge> edges;
    for (std::uint32_t i = 1; i < nodes; ++i) edges.emplace_back(i - 1, i);
    return edges;
}
std::vector<Graph::Edge> clique(std::uint32_t nodes) {
    std::vector<Graph::Edge> edges;
    for (std::uint32_t i = 0; i < nodes; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) edges.emplace_back(i, j);
    }
    return edges;
}

constexpr int seeds = 200;

}  // namespace

TEST_CASE(
    "managed flood on graphs: along a line, hop limit 3 reaches the fourth node over three "
    "relays") {
    CHECK(flooded(5, line(5)) == Flooded{4, {{1, 1}, {2, 2}, {3, 3}, {4, 4}}});
    CHECK(flooded(6, line(6)) == Flooded{4, {{1, 1}, {2, 2}, {3, 3}, {4, 4}}});
    for (int h = 1; h <= 7; ++h) {
        CHECK(flooded(10, line(10), {.hop_limit = h}).hops.size() ==
              static_cast<std::size_t>(h + 1));
    }
}

TEST_CASE(
    "managed flood on graphs: if all nodes are clients and hear each other, the first that relays "
    "stops the others") {
    // Relays of the same slot cannot cancel each other: n - 1 nodes in 256 slots, and the first
    // slot is shared by two of them with a probability below (n - 1) / 512.
    for (const std::uint32_t n : {3U, 5U, 10U}) {
        int alone = 0;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const Flooded run = flooded(n, clique(n), {.seed = seed});
            CHECK(run.hops.size() == n - 1);
            CHECK(run.transmissions >= 2);
            CHECK(run.transmissions <= 3);
            alone += run.transmissions == 2;
        }
        CHECK(alone >= seeds - 12);  // 4 sigma above 200 * 9 / 512 = 3.5
    }
}

TEST_CASE(
    "managed flood on graphs: if all nodes are neighbours and some are routers, only the routers "
    "relay") {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        for (const int r : {1, 2, 4}) {
            std::vector<std::string_view> roles(8, "client");
            std::fill_n(roles.begin() + 3, r, "router");
            CHECK(flooded(8, clique(8), {.roles = roles, .seed = seed}).transmissions == 1 + r);
        }
    }
}

TEST_CASE(
    "managed flood on graphs: a `router_late` relays a message even after a client has relayed "
    "it") {
    int clients_first = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Flooded run =
            flooded(3, clique(3), {.roles = {"", "client", "router_late"}, .seed = seed});
        CHECK((run.transmissions == 2 || run.transmissions == 3));
        clients_first += run.transmissions == 3;
    }
    CHECK(std::abs(clients_first - seeds / 2) < 28);  // 4 sigma of 200 fair draws
}

TEST_CASE("managed flood on graphs: nodes with the role `mute` never relay") {
    const std::vector<std::string_view> mutes{"", "mute", "mute", "mute", "mute"};
    CHECK(flooded(5, clique(5), {.roles = mutes}) == Flooded{1, {{1, 1}, {2, 1}, {3, 1}, {4, 1}}});
    const std::vector<Graph::Edge> star{{0, 1}, {1, 2}, {1, 3}, {1, 4}};
    const Flooded around{2, {{1, 1}, {2, 2}, {3, 2}, {4, 2}}};
    CHECK(flooded(5, star, {.roles = {"", "client", "mute", "mute", "mute"}}) == around);
    // Leaves that are clients do not hear each other, and all relay to the centre in vain.
    CHECK(flooded(5, star) == Flooded{5, around.hops});
}

TEST_CASE(
    "managed flood on graphs: a node that hears the message from two relays does not relay it "
    "itself") {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        CAPTURE(seed);
        const Flooded run = flooded(4, {{0, 1}, {0, 2}, {1, 3}, {2, 3}}, {.seed = seed});
        CHECK(run == Flooded{3, {{1, 1}, {2, 1}, {3, 2}}});
    }
}

TEST_CASE(
    "managed flood on graphs: the node that hears the source with the weakest signal relays "
    "first") {
    // Node 2 is far: its 8 slots lie before most of the 256 of node 1, so it loses 4 / 256 at most.
    int far_first = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Flooded run =
            flooded(5, {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 4}},
                    {.snr = [](NodeId, NodeId to) { return to == NodeId{2} ? -20_dB : 10_dB; },
                     .seed = seed});
        far_first += run.hops.contains(4) && !run.hops.contains(3);
    }
    CHECK(far_first >= seeds - 12);
}

TEST_CASE(
    "managed flood on graphs: a path with more hops but shorter delays may use up the hop limit") {
    // 0-1-2-3, and a long way 0-4-5-2 of routers, which relay before client 1.
    const std::vector<Graph::Edge> edges{{0, 1}, {1, 2}, {2, 3}, {0, 4}, {4, 5}, {5, 2}};
    Options options{.roles = {"", "", "", "", "router", "router"},
                    .snr = [](NodeId from, NodeId to) {
                        return from == NodeId{5} && to == NodeId{2} ? 10_dB : -20_dB;
                    }};
    int replaced = 0;
    for (options.seed = 1; options.seed <= seeds; ++options.seed) {
        CAPTURE(options.seed);
        // Node 2 has heard hop limit 0 when it hears 1.
        options.hop_limit = 2;
        const Flooded ended = flooded(6, edges, options);
        CHECK(ended.hops == std::map<std::uint32_t, int>{{1, 1}, {2, 3}, {4, 1}, {5, 2}});
        // Node 2 queues a copy of hop limit 1 when it hears 2, unless it has sent it already.
        options.hop_limit = 3;
        const Flooded reached = flooded(6, edges, options);
        REQUIRE(reached.hops.contains(3));
        CHECK((reached.hops.at(3) == 3 || reached.hops.at(3) == 4));
        replaced += reached.hops.at(3) == 3;
    }
    // At most 17 of the 256 slots of node 2 end before node 1 has sent.
    CHECK(replaced >= seeds * 9 / 10);
}

}  // namespace managed_test
