// SPDX-License-Identifier: MIT
// AODV's searches, by receptions that the test makes up: requests, replies, waits, unusual keys.
// Names begin with the section of RFC 3561.
#include "test/routing/aodv/aodv_node.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace aodv_search_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::AodvNode;
using test::request;

namespace {

constexpr Time start = start_of_run;

/// TTLs of the requests of a search without answers.
std::vector<int> ttls(Aodv aodv) {
    AodvNode n(aodv);
    n.send(5);
    while (n.link.drops.empty()) n.wait();
    std::vector<int> all;
    for (const auto& [frame, asked] : n.sent<aodv::Request>()) all.push_back(frame.ttl);
    return all;
}

/// Requests for a destination that were sent so far.
int asked_for(const AodvNode& n, std::uint32_t to) {
    int count = 0;
    for (const auto& [frame, asked] : n.sent<aodv::Request>())
        count += asked.destination == NodeId{to};
    return count;
}

aodv::Reply reply(std::uint32_t to, std::uint32_t number, std::uint32_t originator) {
    return {.hops = 1,
            .destination = NodeId{to},
            .number = number,
            .originator = NodeId{originator},
            .lifetime = 6s};
}

}  // namespace

TEST_CASE("aodv 6.4: the TTL of a request is never above the network's diameter") {
    using Ttls = std::vector<int>;
    CHECK(ttls({.net_diameter = 1}) == Ttls{1, 1, 1});
    CHECK(ttls({.net_diameter = 2}) == Ttls{1, 2, 2, 2});
    CHECK(ttls({.net_diameter = 4}) == Ttls{1, 3, 4, 4, 4});
    CHECK(ttls({.net_diameter = 7}) == Ttls{1, 3, 5, 7, 7, 7});
    CHECK(ttls({.net_diameter = 8}) == Ttls{1, 3, 5, 7, 8, 8, 8});
    CHECK(ttls({.net_diameter = 255, .rreq_retries = 0}) == Ttls{1, 3, 5, 7, 255});
    CHECK(ttls({.rreq_retries = 0, .rings = false}) == Ttls{35});
    CHECK(ttls({.rings = false}) == Ttls{35, 35, 35});
}

TEST_CASE("aodv 6.4: if the lost destination was many hops away, the whole network is searched") {
    AodvNode n;
    n.learn(5, 1, 10, 4);
    n.learn(6, 1, 10, 5);
    n.link.time += 4s;
    n.send(5);
    CHECK(n.sent<aodv::Request>().back().first.ttl == 7);  // 5 hops + 2
    n.send(6);
    CHECK(n.sent<aodv::Request>().back().first.ttl == 35);  // 8 is above the threshold
}

TEST_CASE("aodv 6.3: with extreme parameters, searches still end") {
    AodvNode n({.node_traversal_time = 10000s, .net_diameter = 255, .rreq_retries = 100});
    n.send(5);
    n.run(start + 30s);
    CHECK(n.link.drops.size() == 1);
    CHECK(n.link.drops[0].reason == DropReason::timeout);
    for (int i = 0; i < 40 && !n.link.timers.empty(); ++i) n.wait();
    CHECK(n.link.timers.empty());
    CHECK_THROWS_AS(AodvRules::of({.hello = 10001s}), std::invalid_argument);
    CHECK_THROWS_AS(AodvRules::of({.my_route_timeout = 10001s}), std::invalid_argument);
}

TEST_CASE("aodv 6.3: a search ends if no message waits for it") {
    AodvNode n({.rreq_retries = 100, .buffer = 1});
    n.send(5);
    n.send(6);  // the message to 5 has to leave
    REQUIRE(n.link.drops.size() == 1);
    n.run(start + 29s);
    CHECK(asked_for(n, 5) == 1);
    CHECK(asked_for(n, 6) > 5);
    const int before = asked_for(n, 6);
    n.run(start + 600s);
    CHECK(asked_for(n, 6) == before);
    CHECK(n.link.drops.size() == 2);
    CHECK(n.link.timers.empty());
}

TEST_CASE(
    "aodv 6.3: only ten requests are sent each second; further requests and their messages wait") {
    AodvNode n({.rings = false}, 40);
    for (std::uint32_t to = 10; to < 35; ++to) n.send(to);
    n.run(start + 999ms);
    CHECK(n.sent<aodv::Request>().size() == 10);
    n.run(start + 1001ms);
    CHECK(n.sent<aodv::Request>().size() == 20);
    n.run(start + 2001ms);
    for (std::uint32_t to = 10; to < 35; ++to) CHECK(asked_for(n, to) == 1);
    n.run(start + 60s);
    CHECK(n.link.drops.size() == 25);
    std::vector<Time> times;
    for (const auto& each : n.link.sent) times.push_back(each.at);
    for (std::size_t i = 10; i < times.size(); ++i) CHECK(times[i] - times[i - 10] >= 1s);
}

TEST_CASE(
    "aodv 6.3, profile ns2: a late reply to an earlier search is not used to measure the time per "
    "hop") {
    AodvNode n({.profile = AodvProfile::ns2}, 40);
    n.link.time += 100s;
    for (std::uint32_t to = 10; to < 21; ++to) n.send(to);
    CHECK(asked_for(n, 20) == 0);  // the eleventh
    n.hear(1, reply(20, 4, 0));    // to an older request
    REQUIRE(n.data().size() == 1);
    n.run(start + 120s);
    n.send(20);
    CHECK(n.sent<aodv::Request>().back().first.ttl == 4);  // 2 hops + 2
    n.run(start + 120500ms);  // waited 2 * 4 * 30 ms; looked at every 0.5 s
    CHECK(asked_for(n, 20) == 2);
}

TEST_CASE(
    "aodv 6.3, profile ns2: a search that took no time does not change the measured time per hop") {
    AodvNode n({.profile = AodvProfile::ns2});
    n.send(5);
    n.hear(1, reply(5, 4, 0));
    n.run(start + 20s);
    n.send(5);
    n.run(start + 20500ms);
    CHECK(asked_for(n, 5) == 3);
}

TEST_CASE(
    "aodv 6.3, profile ns2: the wait for a reply follows from the time per hop of earlier "
    "searches") {
    AodvNode n({.profile = AodvProfile::ns2});
    n.send(5);
    n.link.time += 800ms;
    n.hear(1, reply(5, 4, 0));  // 2 hops: 0.4 s each
    n.run(start + 20s);
    n.send(5);  // TTL 4: waits for 3.2 s, looked at every 0.5 s
    n.run(start + 23s);
    CHECK(asked_for(n, 5) == 2);
    n.run(start + 23500ms);
    CHECK(asked_for(n, 5) == 3);
}

TEST_CASE(
    "aodv 6.3, profile ns2: the time per hop is also measured if the destination itself replies") {
    AodvNode n({.profile = AodvProfile::ns2});
    n.send(5);
    n.link.time += 800ms;
    aodv::Reply own = reply(5, 4, 0);
    own.hops = 0;
    n.hear(5, own);  // 1 hop: 0.8 s
    n.run(start + 20s);
    n.send(5);  // TTL 3: waits for 4.8 s, looked at every 0.5 s
    n.run(start + 24500ms);
    CHECK(asked_for(n, 5) == 2);
    n.run(start + 25s);
    CHECK(asked_for(n, 5) == 3);
}

TEST_CASE(
    "aodv 6.3, profile ns2: after a failed search, a new search for the same destination waits 10 "
    "s") {
    AodvNode n({.profile = AodvProfile::ns2});
    n.send(5);
    while (n.link.drops.empty()) n.wait();
    const int before = asked_for(n, 5);
    CHECK(before == 4);
    const Time given_up = n.link.time;
    n.link.time += 1s;
    n.send(5);
    n.run(given_up + 9s);
    CHECK(asked_for(n, 5) == before);
    n.run(given_up + 10500ms);
    CHECK(asked_for(n, 5) == before + 1);
}

TEST_CASE(
    "aodv 6.1: after the largest sequence number comes 0, for the node itself and for "
    "destinations") {
    AodvRules rules = AodvRules::of({});
    rules.first_number = 0xffffffff;
    AodvNode n;
    n.router = AodvRouter(rules);
    n.send(5);
    CHECK(n.sent<aodv::Request>().back().second.originator_number == 0);
    aodv::Request asked = request(3, 0);
    asked.number = 0xfffffff0;  // older than 0
    n.hear(3, asked);
    CHECK(n.sent<aodv::Reply>().back().second.number == 0);
    n.learn(6, 1, 0xffffffff);
    n.learn(6, 2, 0, 7);  // newer
    CHECK(n.route(6)->next_hop == NodeId{2});
    n.learn(7, 1, 0xffffffff);
    n.hear(1, aodv::Error{.lost = {{NodeId{7}, 0}}});
    CHECK(n.route(7)->number == std::optional<std::uint32_t>(0));
}

TEST_CASE(
    "aodv 6.2: a route lasts as long as its reply says, and later replies never shorten a valid "
    "route") {
    AodvNode n;
    n.learn(5, 1, 10);
    CHECK(n.route(5)->until == start + 3s);
    aodv::Reply longer = reply(5, 10, 0);
    n.hear(1, longer);  // as new, from the same neighbour
    CHECK(n.route(5)->until == start + 6s);
    longer.lifetime = 50s;
    n.hear(2, longer);  // not taken
    CHECK(n.route(5)->until == start + 6s);
    longer.lifetime = 1s, longer.number = 11;
    n.hear(1, longer);
    CHECK(n.route(5)->until == start + 6s);
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 12}}});
    longer.number = 12;
    n.hear(1, longer);
    CHECK(n.route(5)->until == start + 1s);  // a broken one's end is another time
    n.hear(1, aodv::Error{.lost = {{NodeId{5}, 13}}});
    longer.lifetime = 50s;
    n.hear(1, longer);  // older than the broken one, whose memory does not grow
    CHECK(n.route(5)->until == start + 15s);
}

TEST_CASE(
    "aodv 6.5: when a neighbour is heard, the route to it is extended to at least 3 s, never "
    "shortened") {
    AodvNode n;
    n.hear(2, request(2, 9, 1), 1);  // a route of 5.52 s
    n.hear(2, request(7, 9, 1), 3);
    CHECK(n.route(2)->until == start + 5520ms);
    n.link.time = start + 10s;  // broken, and remembered until 20.52 s
    n.hear(2, request(7, 9, 2, 6), 3);
    CHECK(n.route(2)->is_valid);
    CHECK(n.route(2)->until == start + 13s);
    CHECK(n.route(2)->since == start + 10s);
}

TEST_CASE(
    "aodv 6.2: if a neighbour's sequence number is unknown, a reply with any sequence number is "
    "accepted") {
    AodvNode n;
    n.forward(7, 2, 9);
    n.hear(2, request(7, 9), 3);
    CHECK(n.route(2)->number == std::nullopt);
    CHECK(n.route(2)->hops == 1);
    n.hear(1, reply(2, 0x80000000, 7));
    CHECK(n.route(2)->number == std::optional<std::uint32_t>(0x80000000));
    CHECK(n.route(2)->next_hop == NodeId{1});
    n.hear(2, request(8, 9, 1), 3);  // heard again: it is one hop away, with its number
    CHECK(n.route(2)->next_hop == NodeId{2});
    CHECK(n.route(2)->number == std::optional<std::uint32_t>(0x80000000));
}

TEST_CASE(
    "aodv 6.5: the reverse route lasts 2 NET_TRAVERSAL_TIME, minus 2 NODE_TRAVERSAL_TIME per hop") {
    AodvNode n;
    n.hear(2, request(7, 9), 3);
    CHECK(n.route(7)->until == start + 5600ms - 6 * 40ms);
    CHECK(n.route(7)->number == std::optional<std::uint32_t>(5));
    CHECK(n.route(2)->until == start + 3s);
    n.hear(3, request(8, 9), 200);
    CHECK(n.route(8)->until == start + 40ms);  // not in the past
}

TEST_CASE(
    "aodv 6.5: a forwarded request keeps its destination sequence number if the node knows only an "
    "older one") {
    AodvNode n;
    n.learn(5, 1, 20);
    aodv::Request asked = request(7, 5);
    asked.number = 21;
    CHECK(n.hear(2, asked) == Fate::waiting);
    CHECK(n.sent<aodv::Request>().back().second.number == std::optional<std::uint32_t>(21));
    CHECK(n.route(5)->number == std::optional<std::uint32_t>(20));  // and not adopted
}

TEST_CASE("aodv 6.5: the ids of requests are remembered for each originator, for 5.6 s") {
    AodvNode n;
    CHECK(n.hear(2, request(7, 5, 1)) == Fate::waiting);
    CHECK(n.hear(2, request(8, 5, 1)) == Fate::waiting);
    n.link.time += 5600ms;
    CHECK(n.hear(2, request(7, 5, 1)) == Fate::duplicate);
    n.link.time += 5601ms;
    CHECK(n.hear(2, request(7, 5, 1, 9)) == Fate::waiting);
}

TEST_CASE(
    "aodv 6.6.2: a node that replied for the destination reports a broken link on one side to the "
    "other side") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    CHECK(n.hear(2, request(7, 5), 3) == Fate::arrived);
    SUBCASE("a break towards the destination is reported towards the originator") {
        n.forward(7, 2, 5);
        n.fail_last();
        CHECK(n.sent<aodv::Error>().back().first.next_hop == NodeId{2});
    }
    SUBCASE("a break towards the originator is reported towards the destination") {
        n.forward(5, 1, 7);
        n.fail_last();
        CHECK(n.sent<aodv::Error>().back().first.next_hop == NodeId{1});
    }
}

TEST_CASE(
    "aodv 6.6.2: a node that does not know the destination's sequence number sends no reply") {
    AodvNode n;
    n.hear(5, request(8, 9));  // 5 is a neighbour of unknown number
    CHECK(n.route(5)->is_valid);
    CHECK(n.hear(2, request(7, 5)) == Fate::waiting);
    CHECK(n.sent<aodv::Reply>().empty());
}

TEST_CASE("aodv 6.6.2: a reply of an intermediate node has the remaining lifetime of its route") {
    AodvNode n;
    n.learn(5, 1, 20);
    n.link.time += 1s;
    n.hear(2, request(7, 5));
    CHECK(n.sent<aodv::Reply>().back().second.lifetime == 2s);
    CHECK(n.link.message(n.sent<aodv::Reply>().back().first.message).size == 48);
}

TEST_CASE("aodv 6.6.2: the lifetime in a reply is rounded down to whole ms") {
    AodvNode n;
    n.learn(5, 1, 20);
    n.link.time += 1500us;
    n.hear(2, request(7, 5));
    CHECK(n.sent<aodv::Reply>().back().second.lifetime == 2998ms);
}

TEST_CASE("aodv 6.7: a reply does not travel beyond its TTL") {
    AodvNode n;
    n.hear(2, request(7, 5), 3);
    CHECK(n.hear(1, aodv::to_bytes(reply(5, 9, 7)), aodv::reply_kind, 2, 1) == Fate::arrived);
    CHECK(n.sent<aodv::Reply>().empty());
}

TEST_CASE(
    "aodv 6.3: a search repeats its request on time, even while another search waits for a reply") {
    AodvNode n;
    n.send(5);
    n.run(start + 2s);  // waits until 4.72 s
    n.send(6);
    n.run(start + 2300ms);
    CHECK(asked_for(n, 6) == 2);
}

TEST_CASE(
    "aodv 6.6.3: with flag G (gratuitous), the answering node also sends the destination a route "
    "to the originator") {
    AodvNode n;
    n.learn(5, 1, 20, 3);
    aodv::Request asked = request(7, 5);
    asked.gratuitous = true;
    CHECK(n.hear(2, asked, 3) == Fate::arrived);
    const auto replies = n.sent<aodv::Reply>();
    REQUIRE(replies.size() == 2);
    CHECK(replies[0].first.next_hop == NodeId{2});
    const auto [frame, back] = replies[1];
    CHECK(frame.next_hop == NodeId{1});
    CHECK(back.destination == NodeId{7});
    CHECK(back.originator == NodeId{5});
    CHECK(back.hops == 3);
    CHECK(back.number == 5);
    CHECK(back.lifetime == 5600ms - 6 * 40ms);
    AodvNode keys({.destination_only = true, .gratuitous = true});
    keys.send(5);
    CHECK(keys.sent<aodv::Request>()[0].second.destination_only);
    CHECK(keys.sent<aodv::Request>()[0].second.gratuitous);
    const std::string bytes = aodv::to_bytes(keys.sent<aodv::Request>()[0].second);
    CHECK(bytes[1] == 0x38);  // G, D, U
}

TEST_CASE(
    "aodv 6.7: a forwarded reply extends the reverse route; later breaks are reported to both "
    "ends") {
    AodvNode n;
    n.hear(2, request(7, 5), 3);
    n.link.time += 4s;
    CHECK(n.hear(1, reply(5, 9, 7), 2) == Fate::waiting);
    CHECK(n.route(7)->until == n.link.time + 3s);
    const Frame sent = n.sent<aodv::Reply>().back().first;
    CHECK(sent.hops == 3);
    CHECK(n.link.sent.back().queued.heard_from == NodeId{1});
    SUBCASE("a break of the link to the destination is reported towards the originator") {
        n.forward(7, 2, 5);
        n.fail_last();
        CHECK(n.sent<aodv::Error>().back().first.next_hop == NodeId{2});
        CHECK(n.sent<aodv::Error>().back().second.lost.size() == 2);
    }
    SUBCASE("a break of the link to the originator is reported towards the destination") {
        n.hear(2, request(2, 9, 2000), 1);
        n.forward(5, 1, 7);
        n.fail_last();
        CHECK(n.sent<aodv::Error>().back().first.next_hop == NodeId{1});
        CHECK(n.sent<aodv::Error>().back().second.lost.size() == 2);
    }
}

TEST_CASE("aodv, rule A16: a reply or HELLO of a neighbour ends the search for this neighbour") {
    AodvNode n({.hello = 1s});
    n.send(3);
    n.send(4);
    n.hear(3, reply(9, 4, 8));
    n.hear(4, aodv::to_bytes(aodv::Reply{.destination = NodeId{4}, .originator = NodeId{4}}),
           aodv::hello_kind);
    REQUIRE(n.data().size() == 2);
    n.run(start + 40s);
    CHECK(n.sent<aodv::Request>().size() == 2);
    CHECK(n.link.drops.empty());
}

TEST_CASE("aodv, rule A16: a request forwarded by a neighbour ends the search for this neighbour") {
    AodvNode n;
    n.send(3);
    n.hear(3, request(8, 9), 2);
    CHECK(n.data().size() == 1);
}

TEST_CASE(
    "aodv, rule A16: a learnt route also ends a search that has not yet sent its first request") {
    AodvNode n({}, 40);
    for (std::uint32_t to = 10; to < 21; ++to) n.send(to);
    n.learn(20, 1, 4);
    REQUIRE(n.data().size() == 1);
    n.run(start + 40s);
    CHECK(asked_for(n, 20) == 0);
}

TEST_CASE(
    "aodv: messages that waited for a route are sent 10 ms apart with profile ns2, at once with "
    "profile rfc") {
    for (const Duration apart : {0ms, 10ms}) {
        AodvNode n({.profile = apart > 0ms ? AodvProfile::ns2 : AodvProfile::rfc});
        for (int i = 0; i < 3; ++i) n.send(5);
        n.learn(5, 1, 4);
        std::vector<Time> times;
        for (const auto& each : n.link.sent) {
            if (n.link.message(each.queued.frame.message).kind.empty()) times.push_back(each.at);
        }
        REQUIRE(times.size() == 3);
        CHECK(times[1] - times[0] == apart);
        CHECK(times[2] - times[1] == apart);
    }
}

TEST_CASE("aodv: if all lifetimes of routes are 0, the run still ends") {
    AodvNode n({.active_route_timeout = Duration{0}, .my_route_timeout = Duration{0}});
    n.send(5);
    n.learn(5, 1, 10);
    n.hear(2, request(7, 0));
    n.forward(7, 2, 5);
    n.run(start + 60s);
    CHECK(n.link.timers.empty());
}

}  // namespace aodv_search_test
