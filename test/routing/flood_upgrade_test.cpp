// SPDX-License-Identifier: MIT
// What a node makes of later copies, one by one.
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <array>
#include <optional>
#include <vector>

using namespace rovernet;

namespace {

/// Keeps what the router does.
struct Bench final : LinkLayer {
    std::vector<Frame> sent{};
    std::vector<std::uint64_t> timers{};
    Message none{};

    Time now() const override { return start_of_run; }
    std::size_t size() const override { return 2; }
    const Message& message(MessageId) const override { return none; }
    bool is_on(NodeId) const override { return true; }
    std::uint64_t key(NodeId node) const override { return node.value; }
    void broadcast(const Frame& frame, std::optional<NodeId>) override { sent.push_back(frame); }
    void unicast(const Frame& frame, std::optional<NodeId>) override { sent.push_back(frame); }
    void drop(NodeId, const Frame&, DropReason) override {}
    void timer(NodeId, Time, std::uint64_t tag) override { timers.push_back(tag); }
    void hold(MessageId) override {}
    void release(MessageId) override {}
    double draw(Purpose, NodeId, MessageId, std::uint64_t) const override { return 0.5; }
};

/// One node, which hears copies of one message.
struct Hearer {
    FloodRouter router;
    Bench bench{};

    explicit Hearer(bool upgrade) : router(Flood{.ttl = 9, .upgrade = upgrade}) {}
    Fate hear(Hops ttl) {
        std::array heard{Reception{start_of_run, NodeId{1}}};
        const Frame frame{.message = {}, .sender = NodeId{0}, .path = 0, .ttl = ttl, .hops = 1};
        router.on_receive(bench, frame, heard);
        return heard[0].fate;
    }
    void send() { router.on_timer(bench, NodeId{1}, bench.timers.back()); }
};

}  // namespace

TEST_CASE("flood: a copy that waits takes the highest TTL that the node hears, with upgrade only") {
    for (const bool upgrade : {true, false}) {
        Hearer node(upgrade);
        CHECK(node.hear(3) == Fate::waiting);
        for (const Hops ttl : std::array<Hops, 3>{2, 6, 5})
            CHECK(node.hear(ttl) == Fate::duplicate);
        REQUIRE(node.bench.timers.size() == 1);
        node.send();
        REQUIRE(node.bench.sent.size() == 1);
        CHECK(node.bench.sent[0].ttl == (upgrade ? 5 : 2));
        CHECK(node.hear(8) == Fate::duplicate);  // it has sent
    }
}

TEST_CASE("flood: a message that ended at its TTL goes on with a higher one, with upgrade only") {
    for (const bool upgrade : {true, false}) {
        Hearer node(upgrade);
        CHECK(node.hear(1) == Fate::ttl);
        CHECK(node.hear(1) == Fate::duplicate);
        CHECK(node.hear(4) == (upgrade ? Fate::waiting : Fate::duplicate));
        CHECK(node.bench.timers.size() == (upgrade ? 1 : 0));
    }
}
