// SPDX-License-Identifier: MIT
// AODV's results do not depend on the ids of nodes, nor on nodes that take no part; every message
// ends once.
#include "routing/aodv.hpp"
#include "routing/aodv/aodv_packets.hpp"
#include "test/routing/graph.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <string_view>
#include <tuple>
#include <vector>

namespace aodv_order_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Graph;

namespace {

/// Frame as it was sent, by the keys of its nodes.
using Sent = std::tuple<Time, std::uint64_t, std::uint64_t, std::string_view, int, int>;

struct Result {
    std::vector<Sent> sent;
    std::size_t delivered = 0, ended = 0, messages = 0, in_use = 0;
    std::map<std::string_view, int> drops;
};

struct Options {
    Aodv aodv{};
    bool permuted = false, one_more = false;
    double loss = 0;
    bool switches = false;
};

/// A random network of twelve nodes with breaks and joins, which differs by the seed alone.
Result run(std::uint32_t seed, const Options& options) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    constexpr std::uint32_t nodes = 12;
    // id[k] is the id of the node with key 100 + k.
    std::vector<std::uint32_t> id(nodes);
    std::iota(id.begin(), id.end(), 0U);
    std::mt19937 other(seed + 1);
    if (options.permuted) {
        for (std::uint32_t i = nodes - 1; i > 0; --i) std::swap(id[i], id[other() % (i + 1)]);
    }
    Graph graph(nodes + (options.one_more ? 1 : 0), {}, options.aodv);
    graph.keys.resize(nodes);
    for (std::uint32_t k = 0; k < nodes; ++k) graph.keys[id[k]] = 100 + k;
    graph.keys.push_back(50);
    graph.faults = {.loss = options.loss, .seed = seed};
    for (std::uint32_t a = 0; a < nodes; ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            if (b + 1 == a ? below(10) < 8 : below(nodes) < 2) graph.join(id[a], id[b]);
        }
    }
    Result result;
    graph.on_transmit = [&](const Frame& frame) {
        const Message& message = graph.message(frame.message);
        const NodeId next = frame.next_hop;
        result.sent.emplace_back(graph.now(), graph.key(frame.sender),
                                 next == everyone ? 0 : graph.key(next), message.kind, frame.ttl,
                                 frame.hops);
    };
    const auto some_time = [&] { return start_of_run + 1ms * below(20'000); };
    for (int flow = 0; flow < 6; ++flow) {
        const std::uint32_t from = below(nodes), to = (from + 1 + below(nodes - 1)) % nodes;
        for (int i = 0; i < 30; ++i) graph.send(id[from], id[to], some_time());
    }
    for (int i = 0; i < 40; ++i) {
        const std::uint32_t a = id[below(nodes)], b = id[below(nodes)];
        graph.at(some_time(), [&graph, a, b] { graph.cut(a, b); });
        if (a != b) graph.at(some_time(), [&graph, a, b] { graph.join(a, b); });
    }
    for (int i = 0; options.switches && i < 6; ++i) {
        const std::uint32_t node = id[below(nodes)];
        const Time off = some_time();
        graph.at(off, [&graph, node] { graph.switch_node(node, false); });
        graph.at(off + 1ms * below(3000), [&graph, node] { graph.switch_node(node, true); });
    }
    graph.run(start_of_run + 200s);
    for (const auto& each : graph.delivered) {
        result.delivered += each.size();
        result.messages += 1;
    }
    result.drops = graph.drops;
    for (const auto& [code, count] : graph.drops) result.ended += static_cast<std::size_t>(count);
    result.in_use = graph.messages_in_use();
    return result;
}

const std::vector<Aodv> variants{
    {}, {.local_repair = true}, {.gratuitous = true}, {.profile = AodvProfile::ns2}, {.buffer = 2}};

}  // namespace

TEST_CASE("aodv: runs do not depend on how the nodes are numbered") {
    for (const Aodv& aodv : variants) {
        for (std::uint32_t seed = 1; seed <= 40; ++seed) {
            CAPTURE(seed);
            const Result one = run(seed, {.aodv = aodv}),
                         two = run(seed, {.aodv = aodv, .permuted = true});
            CHECK(one.delivered == two.delivered);
            CHECK(one.sent == two.sent);
            CHECK(one.drops == two.drops);
        }
    }
}

TEST_CASE("aodv: an additional node without links does not change which packets are sent") {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        CHECK(run(seed, {}).sent == run(seed, {.one_more = true}).sent);
    }
}

TEST_CASE(
    "aodv: every message is delivered or dropped with a reason, once, and then deleted from "
    "memory") {
    for (Aodv aodv : variants) {
        for (const bool hellos : {false, true}) {
            if (hellos) aodv.hello = 500ms;
            for (std::uint32_t seed = 1; seed <= 40; ++seed) {
                CAPTURE(seed);
                const Result result =
                    run(seed, {.aodv = aodv, .loss = 0.1, .switches = seed % 2 == 0});
                CHECK(result.delivered + result.ended == result.messages);
                CHECK(result.in_use == 0);
                CHECK(result.delivered > 0);
            }
        }
    }
}

TEST_CASE("aodv: HELLOs end some seconds after the last message") {
    Graph graph(3, {{0, 1}, {1, 2}}, Aodv{.hello = 1s});
    for (int i = 0; i < 20; ++i) graph.send(0, 2, start_of_run + 1s + i * 500ms);
    graph.run(start_of_run + 11s);
    const int during = graph.frames[aodv::hello_kind];
    CHECK(during >= 24);  // three nodes for ten seconds, less where a request was broadcast
    graph.run(start_of_run + 14s);
    const int after = graph.frames[aodv::hello_kind];
    graph.run(start_of_run + 100s);
    CHECK(graph.frames[aodv::hello_kind] == after);
}

}  // namespace aodv_order_test
