// SPDX-License-Identifier: MIT
// What a node makes of later copies, one by one.
#include "routing/flood_router.hpp"
#include "test/routing/fake_link_layer.hpp"

#include <doctest/doctest.h>

#include <array>

namespace flood_upgrade_test {
using namespace rovernet;

namespace {

/// One node, which hears copies of one message.
struct Hearer {
    FloodRouter router;
    test::FakeLinkLayer link{2};
    MessageId message = link.message_from({0});

    explicit Hearer(bool upgrade) : router(Flood{.ttl = 9, .upgrade = upgrade}) {}
    Fate hear(Hops ttl, NodeId from = {0}) {
        const Frame frame{.message = message, .sender = from, .ttl = ttl, .hops = 1};
        return link.arrive(router, frame, {1})[0].fate;
    }
};

}  // namespace

TEST_CASE("flood: with `upgrade`, a waiting copy takes the highest TTL that the node hears") {
    for (const bool upgrade : {true, false}) {
        Hearer node(upgrade);
        CHECK(node.hear(3) == Fate::waiting);
        for (const Hops ttl : std::array<Hops, 3>{2, 6, 5})
            CHECK(node.hear(ttl) == Fate::duplicate);
        REQUIRE(node.link.sent.size() == 1);
        CHECK(node.link.go().ttl == (upgrade ? 5 : 2));
        CHECK(node.hear(8) == Fate::duplicate);  // it has sent
    }
}

TEST_CASE("flood: with `upgrade`, the first of several copies with the same TTL is forwarded") {
    Hearer node(true);
    node.hear(4);
    node.hear(4, NodeId{7});
    REQUIRE(node.link.sent.size() == 1);
    CHECK(node.link.sent[0].queued.heard_from == NodeId{0});
    node.hear(5, NodeId{7});
    CHECK(node.link.sent[0].queued.heard_from == NodeId{7});
}

TEST_CASE(
    "flood: with `upgrade`, a message without TTL left is forwarded if a copy with a higher TTL is "
    "heard") {
    for (const bool upgrade : {true, false}) {
        Hearer node(upgrade);
        CHECK(node.hear(1) == Fate::ttl);
        CHECK(node.hear(1) == Fate::duplicate);
        CHECK(node.hear(4) == (upgrade ? Fate::waiting : Fate::duplicate));
        CHECK(node.link.sent.size() == (upgrade ? 1 : 0));
    }
}

}  // namespace flood_upgrade_test
