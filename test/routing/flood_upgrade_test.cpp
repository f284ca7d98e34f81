// SPDX-License-Identifier: MIT
// What a node makes of later copies, one by one.
#include "routing/flood.hpp"
#include "test/routing/fake_link_layer.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace rovernet;

namespace {

/// One node, which hears copies of one message.
struct Hearer {
    FloodRouter router;
    test::FakeLinkLayer link{2};
    MessageId message = link.message_from({0});

    explicit Hearer(bool upgrade) : router(Flood{.ttl = 9, .upgrade = upgrade}) {}
    Fate hear(Hops ttl) {
        const Frame frame{.message = message, .sender = {0}, .ttl = ttl, .hops = 1};
        return link.arrive(router, frame, {1})[0].fate;
    }
};

}  // namespace

TEST_CASE("flood: a copy that waits takes the highest TTL that the node hears, with upgrade only") {
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

TEST_CASE("flood: a message that ended at its TTL goes on with a higher one, with upgrade only") {
    for (const bool upgrade : {true, false}) {
        Hearer node(upgrade);
        CHECK(node.hear(1) == Fate::ttl);
        CHECK(node.hear(1) == Fate::duplicate);
        CHECK(node.hear(4) == (upgrade ? Fate::waiting : Fate::duplicate));
        CHECK(node.link.sent.size() == (upgrade ? 1 : 0));
    }
}
