// SPDX-License-Identifier: MIT
// DSR's rules for broken links and for what nodes overhear, by receptions that the test makes up.
// Names begin with the section of RFC 4728, or with the profile of ns-2.
#include "test/routing/dsr/dsr_node.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

namespace dsr_links_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::DsrNode;
using test::FakeLinkLayer;
using test::Nodes;
using test::Path;
using test::path;
using test::values;

TEST_CASE(
    "dsr 8.3.4: a broken link is reported to the source, and the message takes another route") {
    DsrNode n;
    n.learn(path({7, 3, 0, 4, 5}));
    n.learn(path({0, 4, 5}));
    const auto forward = [&] {
        n.send(5, 7);
        n.arrive();
        n.arrive();
    };
    SUBCASE("the node has another route, and salvages the message") {
        n.learn(path({0, 1, 2, 5}));
        forward();
        n.fail();
        const auto errors = n.sent(dsr::error_kind);
        REQUIRE(errors.size() == 1);
        CHECK(values(errors[0].second.route.value()) == Nodes{0, 3, 7});
        CHECK(errors[0].second.error.value().unreachable == NodeId{4});
        CHECK(errors[0].second.error.value().to == NodeId{7});
        CHECK(n.link.message(errors[0].first.message).size == 20 + 4 + 16 + (4 + 4));
        const Frame salvaged = n.data().back();
        CHECK(salvaged.next_hop == NodeId{1});
        CHECK(values(n.router.header(salvaged).path) == Nodes{0, 1, 2, 5});
        CHECK(n.router.header(salvaged).salvage == 1);
        CHECK(salvaged.bytes == 20 + 4 + 4 + 4 * 3);  // with node 0, which is not its source
        CHECK(n.route_on_air(salvaged) == "0 1 2, salvage 1, left 2");
        CHECK(n.link.drops.empty());
        CHECK(n.route(5) == Nodes{1, 2, 5});
        // 8.3.4: the next error goes to the node that salvaged it.
        n.arrive();
        CHECK(n.route_on_air(n.data().back()) == "0 1 2, salvage 1, left 1");
        n.fail();
        CHECK(n.sent(dsr::error_kind).back().second.error.value().to == NodeId{0});
        CHECK(n.sent(dsr::error_kind).back().second.error.value().salvage == 1);
    }
    SUBCASE("the node has no other route, and drops the message") {
        forward();
        n.fail();
        REQUIRE(n.link.drops.size() == 1);
        CHECK(n.link.drops[0].reason == DropReason::broken);
        CHECK(n.link.drops[0].frame.sender == NodeId{3});  // as it was received
        CHECK(n.route(5).empty());
        CHECK(n.route(4).empty());
        CHECK(n.sent(dsr::request_kind).empty());
    }
    SUBCASE("messages queued for the broken link are dropped, too") {
        forward();
        const std::size_t first = n.link.sent.size() - 1;
        n.link.go();
        forward();
        n.link.go();
        n.link.end(n.router, first, SendResult::retries);
        CHECK(n.link.drops.size() == 2);
        CHECK(n.sent(dsr::error_kind).size() == 2);
        for (std::size_t i = 0; i < n.link.sent.size(); ++i) {
            if (n.link.sent[i].stage != FakeLinkLayer::Stage::gone)
                n.link.end(n.router, i, SendResult::acked);
        }
        CHECK(n.link.messages.size() == 0);  // nothing is held
    }
}

TEST_CASE(
    "dsr 8.3.6: a message is salvaged (sent by another route) at most as often as the key "
    "`salvage` allows") {
    for (const int most : {15, 2, 0}) {
        DsrNode n({.salvage = most});
        n.learn(path({7, 0, 4, 5}));
        n.send(5, 7);
        n.arrive();
        int salvaged = 0;
        while (n.link.drops.empty() && salvaged < 30) {
            // Another neighbour of node 0 has a link to node 5.
            n.learn(path({0, 10 + static_cast<std::uint32_t>(salvaged), 5}));
            const std::size_t before = n.data().size();
            for (std::size_t i = n.link.sent.size(); i-- > 0;) {
                const auto& each = n.link.sent[i];
                if (each.queued.frame.sender != NodeId{0} ||
                    !n.link.message(each.queued.frame.message).kind.empty())
                    continue;
                n.link.sent[i].stage = FakeLinkLayer::Stage::queued;
                n.link.end(n.router, i, SendResult::retries);
                break;
            }
            salvaged += static_cast<int>(n.data().size() - before);
        }
        CHECK(salvaged == most);
        CHECK(n.link.drops.back().reason == DropReason::salvaged);
    }
}

TEST_CASE("dsr: a source whose first link breaks uses another route, or searches for one") {
    DsrNode n;
    n.learn(path({0, 4, 5}));
    n.learn(path({0, 1, 2, 5}));
    n.send(5);
    n.fail();
    CHECK(n.data().back().next_hop == NodeId{1});
    CHECK(n.router.header(n.data().back()).salvage == 0);
    n.fail();
    CHECK(n.sent(dsr::error_kind).empty());  // nobody else is to be told
    CHECK(n.sent(dsr::request_kind).size() == 1);
    CHECK(n.link.drops.empty());
    n.learn(path({0, 3, 5}));
    CHECK(n.data().back().next_hop == NodeId{3});
}

TEST_CASE(
    "dsr 8.3.5: a node that receives a route error forgets the broken link, and forwards the "
    "error") {
    for (const std::uint32_t next : {0U, 9U}) {  // on the way, and overheard
        DsrNode n;
        n.learn(path({0, 4, 5, 6}));
        const Path back = path({4, next, 7});
        CHECK(n.error({.from = {4}, .to = {7}, .unreachable = {5}}, back, 0) ==
              (next == 0 ? Fate::waiting : Fate::arrived));
        CHECK(n.route(5).empty());
        CHECK(n.route(4) == Nodes{4});
        CHECK(n.sent(dsr::error_kind).size() == (next == 0 ? 2 : 1) - 1U);
    }
}

TEST_CASE(
    "dsr 3.4.4: a route error is repeated in the next network-wide request, if that is sent within "
    "1 s") {
    for (const Duration age : {0ms, 1500ms}) {
        DsrNode n;
        n.learn(path({0, 4, 5}));
        n.error({.from = {4}, .to = {0}, .unreachable = {5}}, path({4, 0}), 0);
        n.link.time += age;
        n.send(5);
        CHECK_FALSE(n.sent(dsr::request_kind).back().second.error);
        n.wait();
        const auto [frame, packet] = n.sent(dsr::request_kind).back();
        CHECK(packet.error.has_value() == (age < 1s));
        CHECK(n.link.message(frame.message).size == 32U + (age < 1s ? 16 : 0));
        n.wait();
        CHECK_FALSE(n.sent(dsr::request_kind).back().second.error);
    }
    // Who hears it forgets the link before it answers.
    DsrNode n;
    n.learn(path({0, 4, 5}));
    const dsr::Error error{.from = {4}, .to = {7}, .unreachable = {5}};
    CHECK(n.request(path({7, 3}), 5, 1, 10, error) == Fate::waiting);
    CHECK(n.sent(dsr::reply_kind).empty());
    CHECK(n.sent(dsr::request_kind).back().second.error.value().unreachable == NodeId{5});
}

TEST_CASE(
    "dsr 3.4.3: if a node overhears a message that takes a detour to it, it sends the source a "
    "shorter route") {
    DsrNode n;
    n.learn(path({7, 3, 2, 0, 5}));
    for (int i = 0; i < 2; ++i) {
        n.send(5, 7);
        n.arrive();   // at 3, which sends to 2
        n.arrive(0);  // overheard by 0
        const auto replies = n.sent(dsr::reply_kind);
        REQUIRE(replies.size() == 1);  // once a second
        CHECK(values(replies[0].second.reply.value().path) == Nodes{7, 3, 0, 5});
        CHECK(values(replies[0].second.route.value()) == Nodes{0, 3, 7});
    }
    n.link.time += 1s;
    n.send(5, 7);
    n.arrive();
    n.arrive(0);
    CHECK(n.sent(dsr::reply_kind).size() == 2);
    n.send(5, 7);
    n.arrive();
    n.arrive();
    n.arrive(7);  // 2 sends to 0: node 7 is not to pass it any more
    CHECK(n.sent(dsr::reply_kind).size() == 2);
}

TEST_CASE(
    "dsr 3.3.1: from an overheard packet, a node learns routes over the neighbour that sent the "
    "packet") {
    DsrNode n;
    n.learn(path({7, 3, 2, 5}));
    n.send(5, 7);
    n.arrive();
    n.arrive(0);
    CHECK(n.route(5) == Nodes{3, 2, 5});
    CHECK(n.route(7) == Nodes{3, 7});
    n.reply(path({8, 6, 9}), path({9, 6, 8}), 1);  // from 6 to 8
    CHECK(n.route(8) == Nodes{6, 8});
    CHECK(n.route(9) == Nodes{6, 9});
}

TEST_CASE("dsr: a reply whose next hop is gone is not sent over the broken link again") {
    DsrNode n;
    n.learn(path({0, 1, 7}));
    n.reply(path({7, 2, 0, 6, 8}), path({8, 6, 0, 2, 7}), 1);
    const std::size_t replies = n.sent(dsr::reply_kind).size();
    n.fail();
    CHECK(n.sent(dsr::reply_kind).size() == replies);
    CHECK(values(n.sent(dsr::error_kind).back().second.route.value()) == Nodes{0, 6, 8});
}

TEST_CASE(
    "dsr, profile ns2: a message without a next hop waits at the node, which asks its neighbours "
    "for a route") {
    DsrNode n({.profile = DsrProfile::ns2});
    n.learn(path({7, 3, 0, 4, 5}));
    n.send(5, 7);
    n.arrive();
    n.arrive();
    n.fail();
    CHECK(n.link.drops.empty());
    CHECK(n.sent(dsr::request_kind).size() == 1);
    CHECK(n.sent(dsr::request_kind)[0].first.ttl == 1);
    CHECK(n.link.timers.back().at == start_of_run + 30s);  // only once
    n.link.time += 1s;
    n.send(5);  // an own search begins at the neighbours, too
    CHECK(n.sent(dsr::request_kind).size() == 2);
    CHECK(n.sent(dsr::request_kind)[1].first.ttl == 1);
    n.learn(path({0, 1, 5}));
    CHECK(n.data().back().next_hop == NodeId{1});
    CHECK(n.router.header(n.data()[n.data().size() - 2]).salvage == 1);
    CHECK(n.router.header(n.data().back()).salvage == 0);
}

TEST_CASE("dsr, profile ns2: only the first three messages along a route can shorten it") {
    DsrNode n({.profile = DsrProfile::ns2});
    n.learn(path({7, 3, 2, 0, 5}));
    for (int i = 0; i < 5; ++i) {
        n.link.time += 1s;
        n.send(5, 7);
        n.arrive();
        n.arrive(0);
    }
    CHECK(n.sent(dsr::reply_kind).size() == 3);
    CHECK(n.route(7).empty());
}

}  // namespace dsr_links_test
