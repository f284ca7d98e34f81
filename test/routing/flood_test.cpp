// SPDX-License-Identifier: MIT
#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood_router.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace flood_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// Long after the last copy of any flood here has ended.
constexpr Time end_of_flood = start_of_run + 60s;

/// Keeps the books of a run: every copy has to be somewhere.
struct Ledger {
    std::uint64_t transmissions = 0, originals = 0, forwards = 0;
    std::uint64_t heard = 0, dropped = 0, delivered = 0, revived = 0;
    std::array<std::uint64_t, 4> fates{};  // by Fate
    std::map<NodeId, std::uint64_t> forwards_of{};
    std::map<std::pair<std::uint64_t, NodeId>, int> deliveries{};  // by message and robot
    bool hops_and_ttl_add_up = true;
    int ttl = 0;

    KindMask kinds() const { return kind_all; }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Sent>(&record)) ttl = sent->ttl;
        if (const auto* tx = std::get_if<Transmitted>(&record)) {
            ++transmissions;
            ++(tx->heard_from ? forwards : originals);
            if (tx->heard_from) ++forwards_of[tx->frame.sender];
            hops_and_ttl_add_up &= tx->frame.hops + tx->frame.ttl == ttl + 1 && tx->frame.ttl > 0;
        }
        if (std::holds_alternative<Dropped>(record)) ++dropped;
        if (const auto* rx = std::get_if<Received>(&record)) {
            const auto uid = context.messages[rx->frame.message].uid;
            for (const auto& r : rx->receptions) {
                ++heard;
                ++fates[static_cast<std::size_t>(r.fate)];
                if (r.delivered) ++delivered, ++deliveries[{uid, r.node}];
                revived += r.fate == Fate::waiting && !r.delivered;
            }
        }
    }
    std::uint64_t of(Fate fate) const { return fates[static_cast<std::size_t>(fate)]; }
    std::uint64_t decoded() const { return heard - of(Fate::off); }

    void balances(const Flood& flood) const {
        CHECK(hops_and_ttl_add_up);
        CHECK(transmissions == originals + forwards);
        CHECK(decoded() == of(Fate::waiting) + of(Fate::ttl) + of(Fate::duplicate));
        CHECK(forwards + dropped == of(Fate::waiting));
        for (const auto& [who, times] : deliveries) CHECK(times == 1);
        CHECK(deliveries.size() == delivered);
        if (flood.duplicates == Duplicates::forward) {
            CHECK(of(Fate::duplicate) == 0);
        } else {
            // Whatever is kept or ends at its TTL is a first copy, or one that upgrade revives.
            CHECK(delivered + revived == of(Fate::waiting) + of(Fate::ttl));
            if (!flood.upgrade) CHECK(revived == 0);
        }
    }
};

struct Graph {
    std::string name;
    std::vector<Vec3> at;  // neighbours are 1 m apart
    std::uint32_t source = 0;
};

Graph complete(int n) {
    Graph graph{fmt::format("K{}", n), {}};
    for (int i = 0; i < n; ++i) graph.at.push_back({0.01 * i, 0, 0});
    return graph;
}

Graph grid(int columns, int rows, std::uint32_t source) {
    Graph graph{fmt::format("grid from {}", source), {}, source};
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) graph.at.push_back({1.0 * i, 1.0 * j, 0});
    }
    return graph;
}

/// Floods one message over the graph; the books have to balance.
Ledger flooded(const Graph& graph, const Flood& flood, std::uint64_t seed = 1, Meters range = 1.1_m,
               const std::string& payload = "F") {
    Network net({.seed = seed, .propagation = Disc{.range = range}, .metrics = false});
    for (const Vec3 p : graph.at) net.add({.name = {}, .at = p});
    net.route(flood);
    const auto ledger = std::make_shared<Ledger>();
    net.add_sink(ledger);
    net.send({graph.source}, everyone, payload, {.size = 64});
    net.run_until(end_of_flood);
    ledger->balances(flood);
    CHECK(ledger->originals == 1);
    CHECK(ledger->deliveries.count({0, {graph.source}}) == 0);
    return *ledger;
}

struct Counts {
    std::uint64_t tx, rx;
};

/// Exact counts: transmissions and receptions by TTL, without and with suppression.
struct Exact {
    Graph graph;
    std::vector<std::pair<int, Counts>> by_ttl;  // the numbers of walks in the graph
    Counts suppressed;                           // at a TTL that is large enough
};

std::vector<Exact> exact_counts() {
    return {
        {complete(2),
         {{1, {1, 1}},
          {2, {2, 2}},
          {3, {3, 3}},
          {4, {4, 4}},
          {5, {5, 5}},
          {7, {7, 7}},
          {10, {10, 10}}},
         {2, 2}},
        {complete(3),
         {{1, {1, 2}},
          {2, {3, 6}},
          {3, {7, 14}},
          {4, {15, 30}},
          {5, {31, 62}},
          {7, {127, 254}},
          {10, {1023, 2046}}},
         {3, 6}},
        {complete(5),
         {{1, {1, 4}},
          {2, {5, 20}},
          {3, {21, 84}},
          {4, {85, 340}},
          {5, {341, 1364}},
          {7, {5461, 21844}},
          {10, {349525, 1398100}}},
         {5, 20}},
        {complete(10),
         {{1, {1, 9}}, {2, {10, 90}}, {3, {91, 819}}, {4, {820, 7380}}, {5, {7381, 66429}}},
         {10, 90}},
        {grid(5, 1, 0),
         {{1, {1, 1}},
          {2, {2, 3}},
          {3, {4, 6}},
          {4, {7, 12}},
          {5, {13, 21}},
          {7, {40, 66}},
          {10, {202, 363}}},
         {5, 8}},
        {grid(5, 1, 2),
         {{1, {1, 2}},
          {2, {3, 6}},
          {3, {7, 12}},
          {4, {13, 24}},
          {5, {25, 42}},
          {7, {79, 132}},
          {10, {403, 726}}},
         {5, 8}},
        {grid(5, 5, 12),
         {{1, {1, 4}},
          {2, {5, 20}},
          {3, {21, 80}},
          {4, {81, 296}},
          {5, {297, 1052}},
          {7, {3717, 12896}},
          {10, {155565, 542420}}},
         {25, 80}},
        {grid(5, 5, 0),
         {{1, {1, 2}},
          {2, {3, 8}},
          {3, {9, 26}},
          {4, {27, 86}},
          {5, {87, 284}},
          {7, {969, 3290}},
          {10, {39093, 135968}}},
         {25, 80}},
    };
}

/// Robots at random, and how many hops each is from the first.
struct RandomNetwork {
    Graph graph;
    std::vector<int> hops;
    static constexpr double range = 25;  // [m]

    explicit RandomNetwork(std::uint32_t seed) {
        test::Draw draw(seed);
        for (int i = 0; i < 60; ++i) {
            graph.at.push_back({draw.uniform(0, 100), draw.uniform(0, 100), 0});
        }
        hops.assign(graph.at.size(), 1000);
        hops[0] = 0;
        std::vector<std::size_t> queue{0};
        for (std::size_t next = 0; next < queue.size(); ++next) {
            for (std::size_t i = 0; i < hops.size(); ++i) {
                if (hops[i] < 1000 || distance(graph.at[i], graph.at[queue[next]]) > range)
                    continue;
                hops[i] = hops[queue[next]] + 1;
                queue.push_back(i);
            }
        }
    }
    std::uint64_t within(int ttl) const {
        std::uint64_t n = 0;
        for (const int h : hops) n += h > 0 && h <= ttl;
        return n;
    }
};

}  // namespace

TEST_CASE(
    "flood: with duplicates forwarded, numbers of sent and heard frames equal the numbers of walks "
    "in the graph") {
    for (const auto& [graph, by_ttl, suppressed] : exact_counts()) {
        for (const auto& [ttl, exact] : by_ttl) {
            const std::string which = graph.name + ", ttl " + std::to_string(ttl);
            CAPTURE(which);
            const Ledger run = flooded(graph, {.ttl = ttl, .duplicates = Duplicates::forward});
            CHECK(run.transmissions == exact.tx);
            CHECK(run.heard == exact.rx);
        }
    }
}

TEST_CASE("flood: with duplicates suppressed, each node sends once and hears each neighbour once") {
    for (const auto& [graph, by_ttl, exact] : exact_counts()) {
        for (const bool upgrade : {false, true}) {
            const std::string which = graph.name;
            CAPTURE(which);
            const Ledger run = flooded(graph, {.ttl = 25, .upgrade = upgrade});
            CHECK(run.transmissions == exact.tx);
            CHECK(run.heard == exact.rx);
            CHECK(run.delivered == graph.at.size() - 1);
        }
    }
}

TEST_CASE("flood: with TTL 1 only the neighbours hear the source") {
    for (const auto duplicates : {Duplicates::suppress, Duplicates::forward}) {
        const Ledger run = flooded(grid(5, 5, 12), {.ttl = 1, .duplicates = duplicates});
        CHECK(run.transmissions == 1);
        CHECK(run.delivered == 4);
        CHECK(run.of(Fate::ttl) == 4);
    }
}

TEST_CASE("flood: along a line a message goes exactly as many hops as its TTL") {
    for (int ttl = 1; ttl <= 8; ++ttl) {
        const Ledger run = flooded(grid(20, 1, 0), {.ttl = ttl});
        CHECK(run.delivered == static_cast<std::uint64_t>(ttl));
        CHECK(run.transmissions == static_cast<std::uint64_t>(ttl));
    }
}

TEST_CASE("flood: with ttl_in_payload, the first byte of each message's payload is its TTL") {
    const auto run = [](const Graph& graph, const Flood& flood, const std::string& payload) {
        return flooded(graph, flood, 1, 1.1_m, payload);
    };
    const Flood own{.ttl = 4, .ttl_in_payload = true};
    for (int ttl = 1; ttl <= 8; ++ttl) {
        CHECK(run(grid(20, 1, 0), own, std::string(1, static_cast<char>(ttl)) + "F").delivered ==
              static_cast<std::uint64_t>(ttl));
    }
    CHECK(run(grid(300, 1, 0), own, "\xFF").delivered == 255);
    CHECK(run(grid(20, 1, 0), own, std::string("\0F", 2)).delivered == 1);
    CHECK(run(grid(20, 1, 0), own, "").delivered == 4);
    CHECK(run(grid(20, 1, 0), {.ttl = 4}, "\x02").delivered == 4);
    // Every copy is forwarded: as many as there are walks of that length.
    for (const auto& [graph, by_ttl, suppressed] : exact_counts()) {
        for (const auto& [ttl, exact] : by_ttl) {
            if (ttl > 7) continue;
            const Ledger all =
                run(graph, {.duplicates = Duplicates::forward, .ttl_in_payload = true},
                    std::string(1, static_cast<char>(ttl)));
            CHECK(all.transmissions == exact.tx);
            CHECK(all.heard == exact.rx);
        }
    }
}

TEST_CASE(
    "flood: with duplicates forwarded, the source forwards copies of its own message, but delivers "
    "none of them") {
    const Ledger run = flooded(complete(2), {.ttl = 5, .duplicates = Duplicates::forward});
    CHECK(run.forwards_of.at({0}) == 2);
    CHECK(run.forwards_of.at({1}) == 2);
    CHECK(run.delivered == 1);
}

TEST_CASE("flood: with duplicates suppressed, the source never forwards") {
    CHECK(flooded(complete(5), {.ttl = 5}).forwards_of.count({0}) == 0);
}

TEST_CASE("flood: a TTL outside of 1 to 65535 and a negative jitter are refused") {
    for (const int ttl : {0, 65536, -1}) {
        CHECK_THROWS_AS(FloodRouter(Flood{.ttl = ttl}), std::invalid_argument);
    }
    CHECK_NOTHROW(FloodRouter(Flood{.ttl = 65535}));
    CHECK_THROWS_AS(FloodRouter(Flood{.jitter = Duration{-1}}), std::invalid_argument);
}

TEST_CASE("flood: a message with TTL 260 crosses 260 hops") {
    const Ledger run = flooded(grid(300, 1, 0), {.ttl = 260});
    CHECK(run.delivered == 260);
}

TEST_CASE(
    "flood: with `upgrade`, a message reaches more robots than without, but none beyond the TTL") {
    std::uint64_t upgraded = 0, first_only = 0, possible = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const RandomNetwork random(seed);
        const int ttl = 4;
        const auto reach = [&](bool upgrade) {
            const Ledger run = flooded(random.graph, {.ttl = ttl, .upgrade = upgrade}, seed,
                                       {RandomNetwork::range});
            for (const auto& [who, times] : run.deliveries) {
                CHECK(random.hops[who.second.index()] <= ttl);
            }
            return run.delivered;
        };
        upgraded += reach(true);
        first_only += reach(false);
        possible += random.within(ttl);
    }
    CHECK(upgraded > first_only);
    CHECK(upgraded <= possible);
}

TEST_CASE("flood: with duplicates forwarded, all robots within the TTL are reached") {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const RandomNetwork random(seed);
        const Ledger run = flooded(random.graph, {.ttl = 3, .duplicates = Duplicates::forward},
                                   seed, {RandomNetwork::range});
        CHECK(run.delivered == random.within(3));
    }
}

TEST_CASE("flood: without jitter, copies are forwarded 1 us after their reception") {
    const Ledger run = flooded(grid(5, 5, 12), {.ttl = 25, .jitter = Duration{0}});
    CHECK(run.transmissions == 25);
    CHECK(run.heard == 80);

    Network net({.propagation = Disc{.range = 1.1_m}, .propagation_delay = false});
    for (int i = 0; i < 3; ++i) net.add({.name = {}, .at = {1.0 * i, 0, 0}});
    net.route(Flood{.jitter = Duration{0}});
    std::vector<Time> heard;
    net.on_receive({2}, [&](const Message&) { heard.push_back(net.now()); });
    net.send({0}, everyone, "F", {.size = 64});
    net.run_until(end_of_flood);
    REQUIRE(heard.size() == 1);
    CHECK(heard[0] == start_of_run + 2 * (238'545ns + 1us));
}

TEST_CASE("flood: with duplicates forwarded, each copy of a message has its own random delay") {
    // The source hears its message back from both neighbours, who send at different times; were
    // the delays equal, so would be the gaps.
    Network net({.propagation = Disc{.range = 1.1_m}, .propagation_delay = false});
    for (const double x : {0.0, -1.0, 1.0}) net.add({.name = {}, .at = {x, 0, 0}});
    net.route(Flood{.ttl = 3, .duplicates = Duplicates::forward});
    struct Echoes {
        std::vector<Time> heard{}, sent{};
        KindMask kinds() const { return kind_of<Received>() | kind_of<Transmitted>(); }
        void on(const Record& record, const RecordContext&) {
            if (const auto* tx = std::get_if<Transmitted>(&record)) {
                if (tx->frame.sender == NodeId{0} && tx->heard_from) sent.push_back(tx->time);
            } else if (const auto& rx = std::get<Received>(record); rx.frame.ttl == 2) {
                heard.push_back(rx.receptions[0].time);
            }
        }
    };
    const auto echoes = std::make_shared<Echoes>();
    net.add_sink(echoes);
    net.send({0}, everyone, "F", {.size = 64});
    net.run_until(end_of_flood);
    REQUIRE(echoes->heard.size() == 2);
    REQUIRE(echoes->sent.size() == 2);
    const Duration gap_heard = echoes->heard[1] - echoes->heard[0];
    CHECK(echoes->sent[1] - echoes->sent[0] != gap_heard);
    CHECK(echoes->sent[1] - echoes->sent[0] != -gap_heard);
}

TEST_CASE(
    "flood: if many robots send many messages, each message is delivered once to every other "
    "robot") {
    Network net({.propagation = Disc{.range = 1.1_m}});
    for (const Vec3 p : grid(4, 4, 0).at) net.add({.name = {}, .at = p});
    const Flood flood{.ttl = 20};
    net.route(flood);
    const auto ledger = std::make_shared<Ledger>();
    net.add_sink(ledger);
    for (std::uint32_t i = 0; i < 16; ++i) {
        net.at(start_of_run + i * 2ms, [&net, i] {
            for (int k = 0; k < 3; ++k) net.send({i}, everyone, "hello");
        });
    }
    net.run_until(end_of_flood);
    ledger->balances(flood);
    CHECK(ledger->delivered == 16 * 3 * 15);
    CHECK(ledger->transmissions == 16 * 3 * 16);
}

TEST_CASE("flood: robots that join during a flood hear and forward the message") {
    for (const int robots : {3, 63, 64, 65, 130}) {
        CAPTURE(robots);
        const auto delivered = [&](const Flood& flood) {
            Network net({.propagation = Disc{.range = 1.1_m}});
            for (int i = 0; i < robots; ++i) net.add({.name = {}, .at = {1.0 * i, 0, 0}});
            net.route(flood);
            const auto ledger = std::make_shared<Ledger>();
            net.add_sink(ledger);
            net.send({0}, everyone, "F");
            net.at(start_of_run + 1ms, [&] {
                for (int i = robots; i < robots + 70; ++i)
                    net.add({.name = {}, .at = {1.0 * i, 0, 0}});
            });
            net.run_until(end_of_flood);
            ledger->balances(flood);
            return ledger->delivered;
        };
        const auto all = static_cast<std::uint64_t>(robots + 69);
        CHECK(delivered({.ttl = 300, .upgrade = false}) == all);
        CHECK(delivered({.ttl = 300}) == all);
        CHECK(delivered({.ttl = 5, .duplicates = Duplicates::forward}) == 5);
    }
}

TEST_CASE(
    "flood: all receptions are accounted for if robots are switched off and on during floods") {
    for (const auto duplicates : {Duplicates::suppress, Duplicates::forward}) {
        const Flood flood{.ttl = 4, .duplicates = duplicates};
        Network net({.propagation = Disc{.range = 1.1_m}});
        for (const Vec3 p : grid(5, 5, 0).at) net.add({.name = {}, .at = p});
        net.route(flood);
        const auto ledger = std::make_shared<Ledger>();
        net.add_sink(ledger);
        test::Draw draw(9);
        net.every(5ms, [&] {
            if (net.now() > start_of_run + 2s) return;
            net.send({static_cast<std::uint32_t>(draw.below(25))}, everyone, "F");
        });
        for (int i = 0; i < 2000; ++i) {
            const NodeId node{static_cast<std::uint32_t>(draw.below(25))};
            const Time t = start_of_run + i * 1ms + draw.below(1000) * 1us;
            net.at(t, [&net, node] { net.switch_off(node); });
            net.at(t + draw.below(20'000) * 1us, [&net, node] { net.switch_on(node); });
        }
        net.run_until(end_of_flood);
        ledger->balances(flood);
        CHECK(ledger->of(Fate::off) > 0);
        CHECK(ledger->dropped > 0);
        CHECK(ledger->delivered > 1000);
    }
}

}  // namespace flood_test
