// SPDX-License-Identifier: MIT
// AODV's links and lifetimes, by receptions that the test makes up: HELLOs, broken links, repairs,
// restarts, one-way links. Names begin with the section of RFC 3561.
#include "test/routing/aodv/aodv_node.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace aodv_links_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::AodvNode;
using test::request;

namespace {

constexpr Time start = start_of_run;

void hear_hello(AodvNode& n, std::uint32_t from, std::uint32_t number = 1) {
    n.hear(from,
           aodv::to_bytes(aodv::Reply{.destination = NodeId{from},
                                      .number = number,
                                      .originator = NodeId{from},
                                      .lifetime = 2s}),
           aodv::hello_kind);
}

/// HELLOs that were sent so far.
std::vector<std::pair<Frame, aodv::Reply>> hellos(const AodvNode& n) {
    auto all = n.sent<aodv::Reply>();
    std::erase_if(all, [&](const auto& each) {
        return n.link.message(each.first.message).kind != aodv::hello_kind;
    });
    return all;
}

/// Node 0 with HELLOs every second, at 0.5 s, 1.5 s, ...
struct Hellos : AodvNode {
    explicit Hellos(Aodv aodv = {}) : AodvNode(with_hellos(aodv)) {
        router.on_start(link, NodeId{0});
    }
    static Aodv with_hellos(Aodv aodv) {
        aodv.hello = 1s;
        return aodv;
    }
};

/// A reply to node 0 with a route that lives long.
void learn_for_long(AodvNode& n, std::uint32_t to, std::uint32_t over, std::uint32_t number = 10) {
    n.hear(over, aodv::Reply{.hops = 1,
                             .destination = NodeId{to},
                             .number = number,
                             .originator = NodeId{0},
                             .lifetime = 60s});
}

}  // namespace

TEST_CASE(
    "aodv 6.2: a route is used even if the route table's entry for its next hop has expired") {
    AodvNode n;
    learn_for_long(n, 5, 1);
    learn_for_long(n, 6, 2);
    n.link.time = start + 18500ms;  // the entries of 1 and 2 were broken at 3 s
    SUBCASE("the node sends its own message by the route") { n.send(5); }
    SUBCASE("the node forwards a message of another node by the route") {
        CHECK(n.forward(7, 3, 5) == Fate::waiting);
    }
    REQUIRE(n.data().size() == 1);
    CHECK(n.data()[0].next_hop == NodeId{1});
}

TEST_CASE(
    "aodv 6.2: with profile ns2, a message extends only the lifetime of the route to its "
    "destination") {
    AodvNode n({.profile = AodvProfile::ns2});
    n.learn(1, 1, 4, 0);
    n.learn(5, 1, 10, 3);
    n.hear(2, request(7, 9), 3);
    n.link.time += 2s;
    const auto next_hop_until = n.route(1)->until, origin_until = n.route(7)->until;
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    CHECK(n.route(5)->until == n.link.time + 10s);
    CHECK(n.route(1)->until == next_hop_until);
    CHECK(n.route(7)->until == origin_until);
    CHECK_FALSE(n.route(2));
}

TEST_CASE(
    "aodv 6.2: a message that has arrived extends the lifetime of the route back to its source") {
    AodvNode n;
    n.hear(2, request(7, 9), 3);
    n.link.time += 2500ms;
    CHECK(n.forward(7, 2, 0) == Fate::arrived);
    CHECK(n.route(2)->until == n.link.time + 3s);
    n.link.time += 2500ms;
    n.forward(7, 2, 0);
    CHECK(n.route(7)->until == n.link.time + 3s);
}

TEST_CASE("aodv 6.2: a message does not shorten the lifetime of its route") {
    AodvNode n;
    learn_for_long(n, 5, 1);
    n.send(5);
    CHECK(n.route(5)->until == start + 60s);
}

TEST_CASE("aodv 6.2: messages that waited for a route also extend the lifetime of the route") {
    AodvNode n;
    n.send(5);
    n.hear(1, aodv::Reply{.hops = 1,
                          .destination = NodeId{5},
                          .number = 3,
                          .originator = NodeId{0},
                          .lifetime = 1s});
    CHECK(n.data().size() == 1);
    CHECK(n.route(5)->until == start + 3s + 1us);
}

TEST_CASE("aodv 6.2: a packet does not travel beyond its TTL") {
    AodvNode n;
    n.learn(5, 1, 10);
    CHECK(n.forward(7, 2, 5, 1) == Fate::ttl);
    CHECK(n.data().empty());
    CHECK(n.forward(7, 2, 5, 2) == Fate::waiting);
    CHECK(n.data()[0].ttl == 1);
    CHECK(n.data()[0].hops == 3);
}

TEST_CASE("aodv 6.9: HELLOs are sent only while the node's routes carry messages") {
    Hellos n;
    n.hear(2, request(7, 9), 3);  // a route, which nobody uses
    n.run(start + 4s);
    CHECK(hellos(n).empty());
    n.pass_reply(7, 2, 5, 1);
    n.run(start + 5s);  // a request was passed on at 4 s
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    n.run(start + 6s);
    REQUIRE(hellos(n).size() == 1);
    const auto [frame, hello] = hellos(n)[0];
    CHECK(frame.next_hop == everyone);
    CHECK(frame.ttl == 1);
    CHECK(n.link.message(frame.message).size == 48);
    CHECK(hello.destination == NodeId{0});
    CHECK(hello.originator == NodeId{0});
    CHECK(hello.hops == 0);
    CHECK(hello.number == 0);  // the own one, which nothing raised
    CHECK(hello.lifetime == 2s);
    hear_hello(n, 1);  // neighbours' HELLOs do not keep the node at it
    n.run(start + 7500ms);
    CHECK(hellos(n).size() == 3);
    for (Time t = start + 8s; t < start + 20s; t += 1s) {
        hear_hello(n, 1);
        n.run(t);
    }
    CHECK(hellos(n).size() == 3);
}

TEST_CASE("aodv 6.9: the destination of messages also sends HELLOs, with profile rfc and ns2") {
    for (const AodvProfile profile : {AodvProfile::rfc, AodvProfile::ns2}) {
        Hellos n({.profile = profile});
        n.forward(7, 2, 0);
        n.run(start + 1s);
        CHECK(hellos(n).size() == 1);
    }
}

TEST_CASE(
    "aodv 6.9: no HELLO is sent if the node has broadcast a request within the HELLO interval") {
    Hellos n;
    n.learn(6, 2, 1);
    n.send(6);
    n.run(start + 600ms);
    CHECK(hellos(n).size() == 1);
    n.send(5);  // a request at 0.6 s, the next one at 0.84 s and 1.24 s
    n.run(start + 1500ms);
    CHECK(n.sent<aodv::Request>().size() == 3);
    CHECK(hellos(n).size() == 1);
}

TEST_CASE(
    "aodv 6.9: a forwarded request replaces a HELLO; a node that forwarded a reply sends HELLOs") {
    Hellos n;
    n.run(start + 400ms);
    n.pass_reply(7, 2, 5, 1);
    n.run(start + 1s);
    CHECK(hellos(n).empty());
    n.run(start + 2s);
    CHECK(hellos(n).size() == 1);
}

TEST_CASE("aodv 6.9: a HELLO makes a route to its sender that lasts at least two HELLO intervals") {
    Hellos n({.active_route_timeout = 1s});
    hear_hello(n, 4, 77);
    REQUIRE(n.route(4));
    CHECK(n.route(4)->number == std::optional<std::uint32_t>(77));
    CHECK(n.route(4)->hops == 1);
    CHECK(n.route(4)->until == start + 2s);
    n.link.time += 1500ms;
    hear_hello(n, 4, 77);
    CHECK(n.route(4)->until == start + 3500ms);
    CHECK(n.sent<aodv::Reply>().empty());  // it goes no further
}

TEST_CASE("aodv 6.9: a neighbour that sent a HELLO and then nothing for two intervals is lost") {
    Hellos n;
    learn_for_long(n, 5, 1);
    n.run(start + 8s);
    CHECK(n.route(5)->is_valid);  // no HELLO from 1: it is not expected to send any
    hear_hello(n, 1);             // at 8 s
    SUBCASE("a neighbour that is silent is lost") {
        n.send(5);  // waits in the queue
        n.run(start + 10s);
        CHECK(n.route(5)->is_valid);
        n.run(start + 10s + 1ns);  // at once, not at the node's next HELLO
        CHECK_FALSE(n.route(5)->is_valid);
        CHECK(n.route(5)->number == std::optional<std::uint32_t>(11));
        REQUIRE(n.link.drops.size() == 1);
        CHECK(n.link.drops[0].reason == DropReason::broken);
        CHECK(n.link.messages.size() == hellos(n).size());  // the message is let go
    }
    SUBCASE("a neighbour that sends any packet is not lost") {
        for (Time t = start + 9s; t < start + 14s; t += 1s) {
            n.run(t);
            switch ((t - start) / 1s % 3) {
                case 0: n.forward(8, 1, 0); break;
                case 1: n.hear(1, aodv::Error{.lost = {{NodeId{9}, 1}}}); break;
                default: n.hear(1, request(1, 9, ++n.last_id, 3)); break;
            }
        }
        CHECK(n.route(5)->is_valid);
    }
}

TEST_CASE("aodv 6.9, 6.13: a node that is off, or silent after a restart, sends no HELLO") {
    Hellos n;
    n.learn(5, 1, 10);
    n.send(5);
    n.router.on_switched(n.link, NodeId{0}, false);
    n.link.on[0] = false;
    n.run(start + 3s);
    CHECK(hellos(n).empty());
    n.link.on[0] = true;
    n.router.on_switched(n.link, NodeId{0}, true);
    n.forward(7, 2, 0);
    n.run(start + 4s);
    CHECK(hellos(n).empty());
    n.run(start + 18s);
    n.forward(7, 2, 0);
    n.run(start + 20s);
    CHECK_FALSE(hellos(n).empty());  // the timer goes on
}

TEST_CASE("aodv 6.11: a message for a broken route extends the time for which the route is kept") {
    AodvNode n;
    n.learn(5, 1, 20);
    n.link.time = start + 17s;  // broken at 3 s with number 21, to be deleted at 18 s
    n.forward(7, 2, 5);
    CHECK(n.sent<aodv::Error>().back().second.lost[0].number == 22);
    n.link.time = start + 31s;
    REQUIRE(n.route(5));
    CHECK(n.route(5)->number == std::optional<std::uint32_t>(22));
    n.link.time = start + 32s;
    CHECK_FALSE(n.route(5));
}

TEST_CASE("aodv 6.11: if several neighbours use the lost routes, they get one broadcast RERR") {
    AodvNode n;
    n.pass_reply(7, 2, 5, 1);
    n.pass_reply(8, 3, 6, 1, 30);
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    n.fail_last();
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    const auto [frame, error] = n.sent<aodv::Error>()[0];
    CHECK(frame.next_hop == everyone);
    CHECK(frame.ttl == 1);
    CHECK(n.link.message(frame.message).size == 32 + 3 * 8);
    CHECK(error.lost.size() == 3);  // 1, 5, 6
}

TEST_CASE("aodv 6.11: a RERR is forwarded to the neighbours that use the broken routes") {
    AodvNode n;
    n.pass_reply(7, 2, 5, 1);
    n.learn(6, 1, 4);  // used by node 0 alone
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 10}, {NodeId{6}, 5}}});
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    const auto [frame, error] = n.sent<aodv::Error>()[0];
    CHECK(frame.next_hop == NodeId{2});
    REQUIRE(error.lost.size() == 1);
    CHECK(error.lost[0].destination == NodeId{5});
    CHECK(error.lost[0].number == 10);
    CHECK(n.link.sent.back().at == n.link.time + 1us);
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 10}}});  // once
    CHECK(n.sent<aodv::Error>().size() == 1);
    CHECK(n.route(5)->until == n.link.time + 15s);
}

TEST_CASE(
    "aodv 6.11, profile ns2: RERRs are broadcast, and forwarded after a random delay (jitter)") {
    AodvNode n({.profile = AodvProfile::ns2, .local_repair = false});
    n.pass_reply(7, 2, 5, 1);
    n.learn(6, 1, 4);
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 10}, {NodeId{6}, 5}}});
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    CHECK(n.sent<aodv::Error>()[0].first.next_hop == everyone);
    CHECK(n.sent<aodv::Error>()[0].second.lost.size() == 1);
    CHECK(n.link.sent.back().at == n.link.time + 1us + 5ms);
    n.learn(6, 1, 7);  // used by node 0 alone
    n.send(6);
    n.fail_last();
    REQUIRE(n.sent<aodv::Error>().size() == 2);
    CHECK(n.sent<aodv::Error>()[1].first.next_hop == everyone);
}

TEST_CASE(
    "aodv 6.11: a broken link ends the valid routes over this link, and does not change other "
    "routes") {
    AodvNode n;
    n.learn(5, 1, 10);
    n.learn(6, 1, 20);
    n.learn(8, 2, 30);
    n.send(5);
    n.send(6);
    n.link.end(n.router, n.link.sent.size() - 1, SendResult::retries);
    CHECK(n.link.drops.size() == 2);  // the message to 5 waited in the queue
    CHECK(n.link.messages.size() == 0);
    CHECK(n.route(5)->until == n.link.time + 15s);
    CHECK(n.route(8)->is_valid);
    n.link.time += 1s;
    n.learn(6, 2, 21);
    n.learn(8, 1, 31);
    n.send(8);
    n.fail_last();
    CHECK(n.route(5)->number == std::optional<std::uint32_t>(11));
    CHECK(n.route(5)->until == start + 15s);
    CHECK(n.route(6)->is_valid);
}

TEST_CASE(
    "aodv, rule A14: if a RERR has the route's own sequence number, the route ends and its number "
    "is incremented") {
    AodvNode n;
    n.learn(5, 1, 20);
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 20}}});
    CHECK_FALSE(n.route(5)->is_valid);
    CHECK(n.route(5)->number == std::optional<std::uint32_t>(21));
}

TEST_CASE("aodv 6.11: neighbours that use a broken route are stored until a RERR can be sent") {
    AodvNode n;
    n.pass_reply(7, 2, 5, 1);
    for (int i = 0; i < 10; ++i) n.forward(8, 3, 9);  // ten reports in this second
    n.forward(7, 2, 5);
    n.fail_last();
    CHECK(n.sent<aodv::Error>().size() == 10);
    n.link.time += 1100ms;
    n.forward(8, 3, 5);  // node 3 had no reply from here
    REQUIRE(n.sent<aodv::Error>().size() == 11);
    CHECK(n.sent<aodv::Error>()[10].first.next_hop == everyone);  // to 2 and 3
}

TEST_CASE(
    "aodv 6.11: a RERR lists at most 255 destinations, in the order of their keys (name hashes)") {
    AodvNode n({}, 400);
    for (std::uint32_t i = 0; i < 400; ++i) n.link.keys.push_back(1000 - i);
    n.pass_reply(7, 2, 10, 1);
    for (std::uint32_t to = 11; to < 300; ++to) n.pass_reply(7, 2, to, 1);
    n.forward(7, 2, 10);
    n.fail_last();
    const auto errors = n.sent<aodv::Error>();
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].second.lost.size() == 255);
    CHECK(errors[1].second.lost.size() == 291 - 255);
    CHECK(errors[0].second.lost[0].destination == NodeId{299});
    CHECK(errors[1].second.lost.back().destination == NodeId{1});
}

TEST_CASE(
    "aodv 6.12: if a repair fails, forwarded messages are dropped, and a search begins for the "
    "node's own messages") {
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    n.forward(7, 2, 5);
    n.fail_last();
    CHECK(n.forward(7, 2, 5) == Fate::waiting);
    n.send(5);
    CHECK(n.sent<aodv::Request>().size() == 2);  // one was passed on, one is of the repair
    CHECK(n.link.drops.empty());
    n.wait();
    REQUIRE(n.link.drops.size() == 2);
    for (const auto& drop : n.link.drops) CHECK(drop.frame.sender == NodeId{2});
    CHECK(n.sent<aodv::Request>().size() == 3);
    CHECK(n.sent<aodv::Error>().size() == 1);
    n.learn(5, 3, 11);
    CHECK(n.data().back().next_hop == NodeId{3});
}

TEST_CASE(
    "aodv 6.12: repairs begin in the order in which messages came; lost routes without messages "
    "are reported later") {
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    n.pass_reply(7, 2, 6, 1);
    n.pass_reply(7, 2, 8, 1);
    n.forward(7, 2, 6);
    n.link.go();
    n.forward(7, 2, 5);
    n.link.go();
    n.link.end(n.router, n.link.sent.size() - 2, SendResult::retries);
    const auto asked = n.sent<aodv::Request>();
    REQUIRE(asked.size() == 5);  // three were passed on
    CHECK(asked[3].second.destination == NodeId{6});
    CHECK(asked[4].second.destination == NodeId{5});
    CHECK(n.sent<aodv::Error>().empty());
    CHECK(n.link.drops.empty());
    n.forward(7, 2, 8);  // now a packet needs it
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    CHECK(n.sent<aodv::Error>()[0].second.lost[0].destination == NodeId{8});
}

TEST_CASE(
    "aodv 6.12: the TTL of a repair request is at least half the number of hops to the source, "
    "plus 2") {
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    const MessageId id = n.link.message_from(NodeId{7}, NodeId{5});
    const Frame frame{
        .message = id, .sender = NodeId{2}, .ttl = 50, .hops = 12, .next_hop = NodeId{0}};
    n.link.arrive(n.router, frame, {0});
    n.fail_last();
    CHECK(n.sent<aodv::Request>().back().first.ttl == 12 / 2 + 2);
}

TEST_CASE(
    "aodv 6.12: the waiting time of a repair follows from the TTL of its request, even at the "
    "largest TTL") {
    AodvNode n({.net_diameter = 10, .local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    const MessageId id = n.link.message_from(NodeId{7}, NodeId{5});
    const Frame frame{
        .message = id, .sender = NodeId{2}, .ttl = 50, .hops = 18, .next_hop = NodeId{0}};
    n.link.arrive(n.router, frame, {0});
    n.fail_last();
    const Time begun = n.link.time;
    CHECK(n.sent<aodv::Request>().back().first.ttl == 10);
    n.wait();
    CHECK(n.link.time == begun + 960ms);
    CHECK(n.link.drops.size() == 1);
}

TEST_CASE("aodv 6.12: a node repairs a route if the destination is within 0.3 network diameters") {
    const auto repairs = [](int net_diameter, int hops) {
        AodvNode n({.net_diameter = net_diameter, .local_repair = true});
        n.pass_reply(7, 2, 5, 1, 9, static_cast<std::uint8_t>(hops - 2));
        REQUIRE(n.route(5)->hops == hops);
        n.forward(7, 2, 5);
        const std::size_t before = n.sent<aodv::Request>().size();
        n.fail_last();
        return n.sent<aodv::Request>().size() > before;
    };
    CHECK(repairs(35, 10));
    CHECK_FALSE(repairs(35, 11));
    CHECK(repairs(100, 30));
    CHECK_FALSE(repairs(100, 31));
    CHECK(repairs(10, 3));
    CHECK_FALSE(repairs(10, 4));
}

TEST_CASE("aodv 6.12: if the repaired route has the same length, no RERR is sent") {
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    n.forward(7, 2, 5);
    n.fail_last();
    n.learn(5, 3, 11, 2);
    CHECK(n.data().back().next_hop == NodeId{3});
    CHECK(n.sent<aodv::Error>().empty());
}

TEST_CASE(
    "aodv 6.12: if a route has a new next hop when a frame to the old next hop fails, no repair is "
    "made") {
    AodvNode n({.local_repair = true});
    n.pass_reply(7, 2, 5, 1);
    n.forward(7, 2, 5);
    const std::size_t handle = n.link.sent.size() - 1;
    n.link.go();
    n.learn(5, 3, 11);
    n.link.end(n.router, handle, SendResult::retries);
    CHECK(n.route(5)->is_valid);
    CHECK(n.sent<aodv::Request>().size() == 1);  // passed on
    CHECK(n.link.drops.size() == 1);
}

TEST_CASE("aodv 6.12: no repair is made far from the destination, or for a node's own messages") {
    AodvNode n({.local_repair = true});
    n.hear(2, request(7, 5), 3);
    n.hear(1, aodv::Reply{.hops = 10,
                          .destination = NodeId{5},
                          .number = 9,
                          .originator = NodeId{7},
                          .lifetime = 6s});
    n.forward(7, 2, 5);
    n.fail_last();
    CHECK(n.link.drops.size() == 1);  // 11 hops
    n.learn(6, 1, 4);
    n.send(6);
    n.fail_last();
    CHECK(n.link.drops.size() == 2);
}

TEST_CASE(
    "aodv 6.12: a RERR with flag N (route was repaired) is forwarded, but leaves the route valid") {
    AodvNode n;
    n.pass_reply(7, 2, 5, 1);
    n.hear(1, aodv::Error{.is_repaired = true, .lost = {{NodeId{5}, 30}}});
    CHECK(n.route(5)->is_valid);
    CHECK(n.route(5)->number == std::optional<std::uint32_t>(9));
    REQUIRE(n.sent<aodv::Error>().size() == 1);
    CHECK(n.sent<aodv::Error>()[0].second.is_repaired);
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 30}}});  // its users are still known
    CHECK(n.sent<aodv::Error>().size() == 2);
}

TEST_CASE(
    "aodv 6.8: a blacklist entry lasts RREQ_RETRIES * NET_TRAVERSAL_TIME; profile ns2 has no "
    "blacklist") {
    const auto answers = [](Aodv aodv, Duration later) {
        AodvNode n(aodv);
        n.hear(2, request(7, 0), 3);
        n.fail_last();
        n.link.time += later;
        const std::size_t before = n.link.sent.size();
        n.hear(2, request(7, 0, 2, 9));
        return n.link.sent.size() > before;
    };
    CHECK_FALSE(answers({}, 5500ms));
    CHECK(answers({}, 5600ms));
    CHECK_FALSE(answers({.rreq_retries = 4}, 11100ms));
    CHECK(answers({.rreq_retries = 4}, 11200ms));
    CHECK(answers({.rreq_retries = 0}, 0ms));
    CHECK(answers({.profile = AodvProfile::ns2}, 0ms));
}

TEST_CASE(
    "aodv 6.13: the sequence number of a broken route is kept as long as the longest-lived route "
    "may last") {
    const auto delete_period = [](Aodv aodv) { return AodvRules::of(aodv).delete_period; };
    CHECK(delete_period({}) == 15s);
    CHECK(delete_period({.profile = AodvProfile::ns2}) == 50s);
    CHECK(delete_period({.hello = 10s}) == 50s);
    CHECK(delete_period({.my_route_timeout = 100s}) == 103s);
    CHECK(delete_period({.active_route_timeout = Duration{0}}) == 5600ms);
    CHECK(delete_period({.node_traversal_time = 400ms}) == 59s);
    CHECK(AodvRules::of({.my_route_timeout = 100s}).silence == 103s);
}

TEST_CASE("aodv 6.13: a node switched on for the first time is not silent") {
    AodvNode n;
    n.router.on_switched(n.link, NodeId{0}, true);
    n.send(5);
    CHECK(n.sent<aodv::Request>().size() == 1);
}

TEST_CASE(
    "aodv 6.13: a message that a silent node should forward is answered with a RERR, and starts "
    "the 15 s of silence anew") {
    AodvNode n;
    n.router.on_switched(n.link, NodeId{0}, false);
    n.router.on_switched(n.link, NodeId{0}, true);
    n.send(5);
    n.link.time += 10s;
    CHECK(n.forward(7, 2, 6) == Fate::waiting);
    CHECK(n.sent<aodv::Error>().size() == 1);
    n.hear(1, aodv::Reply{.hops = 1, .destination = NodeId{6}, .originator = NodeId{0}});
    CHECK_FALSE(n.route(1));
    n.run(start + 24900ms);
    CHECK(n.sent<aodv::Request>().empty());
    n.run(start + 25s);
    CHECK(n.sent<aodv::Request>().size() == 1);
}

TEST_CASE("aodv 6.13: switching a node off drops its waiting packets and cancels its timers") {
    AodvNode n;
    n.send(5);
    n.send(5);
    n.router.on_switched(n.link, NodeId{0}, false);
    REQUIRE(n.link.drops.size() == 2);
    CHECK(n.link.drops[0].reason == DropReason::off);
    n.run(start + 60s);
    CHECK(n.sent<aodv::Request>().size() == 1);
    CHECK(n.link.timers.empty());
    CHECK(n.link.messages.size() == 1);  // the request, in the queue
}

TEST_CASE("aodv: a broadcast goes one hop; if it cannot be sent, it is dropped with a reason") {
    AodvNode n;
    const MessageId id = n.link.message_from(NodeId{0});
    CHECK(n.router.initial_ttl(n.link.message(id)) == 1);
    n.router.send(n.link, NodeId{0}, id);
    REQUIRE(n.data().size() == 1);
    CHECK(n.data()[0].ttl == 1);
    CHECK(n.data()[0].next_hop == everyone);
    n.link.end(n.router, 0, SendResult::queue_full);
    REQUIRE(n.link.drops.size() == 1);
    CHECK(n.link.drops[0].reason == DropReason::queue_full);
    const auto got =
        n.link.arrive(n.router, {.message = id, .sender = NodeId{3}, .ttl = 1, .hops = 1}, {0});
    CHECK(got[0].delivered);
    CHECK(got[0].fate == Fate::arrived);
}

TEST_CASE("aodv: a message that cannot be sent is recorded as dropped, a control packet is not") {
    for (const SendResult result : {SendResult::queue_full, SendResult::off}) {
        AodvNode n;
        n.learn(5, 1, 4);
        n.send(5);
        n.link.end(n.router, n.link.sent.size() - 1, result);
        REQUIRE(n.link.drops.size() == 1);
        CHECK(n.route(5)->is_valid);
        n.send(6);
        n.link.end(n.router, n.link.sent.size() - 1, result);
        CHECK(n.link.drops.size() == 1);
    }
}

}  // namespace aodv_links_test
