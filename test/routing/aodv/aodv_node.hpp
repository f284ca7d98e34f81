// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv/aodv_router.hpp"
#include "test/routing/fake_link_layer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::test {

/// AODV node with id 0, and functions by which a test acts as its neighbours.
struct AodvNode {
    explicit AodvNode(Aodv aodv = {}, std::size_t nodes = 10)
        : link(nodes), router(AodvRules::of(aodv)) {
        link.on_forgotten = [this](MessageId id) { router.forget(id); };
    }

    /// Passes a packet from a neighbour to node 0. @return fate of the packet
    Fate hear(std::uint32_t from, const std::string& bytes, std::string_view kind, Hops hops = 1,
              Hops ttl = 10) {
        const MessageId id = link.originate(NodeId{from}, everyone, kind, 24, bytes);
        const auto got = link.arrive(
            router, {.message = id, .sender = NodeId{from}, .ttl = ttl, .hops = hops}, {0});
        link.release(id);
        return got[0].fate;
    }
    Fate hear(std::uint32_t from, const aodv::Request& r, Hops hops = 1, Hops ttl = 10) {
        return hear(from, aodv::to_bytes(r), aodv::request_kind, hops, ttl);
    }
    Fate hear(std::uint32_t from, const aodv::Reply& r, Hops hops = 1) {
        return hear(from, aodv::to_bytes(r), aodv::reply_kind, hops);
    }
    Fate hear(std::uint32_t from, const aodv::Error& e) {
        return hear(from, aodv::to_bytes(e), aodv::error_kind);
    }
    /// Gives node 0 a route to `to` over the neighbour `over`, by a reply.
    void learn(std::uint32_t to, std::uint32_t over, std::uint32_t number, std::uint8_t hops = 1) {
        hear(over, aodv::Reply{.hops = hops,
                               .destination = NodeId{to},
                               .number = number,
                               .originator = NodeId{0},
                               .lifetime = std::chrono::seconds{3}});
    }
    /// Passes to node 0 a message for `to` from the neighbour `from`. @return fate of the message
    Fate forward(std::uint32_t origin, std::uint32_t from, std::uint32_t to, Hops ttl = 10) {
        const MessageId id = link.message_from(NodeId{origin}, NodeId{to});
        const auto got = link.arrive(
            router,
            {.message = id, .sender = NodeId{from}, .ttl = ttl, .hops = 2, .next_hop = NodeId{0}},
            {0});
        link.release(id);
        return got[0].fate;
    }
    void send(std::uint32_t to) {
        const MessageId id = link.message_from(NodeId{0}, NodeId{to});
        router.send(link, NodeId{0}, id);
        link.release(id);
    }
    /// Advances to the next timer, and serves it.
    void wait() {
        const auto next =
            std::min_element(link.timers.begin(), link.timers.end(),
                             [](const auto& a, const auto& b) { return a.at < b.at; });
        REQUIRE(next != link.timers.end());
        const auto timer = *next;
        link.timers.erase(next);
        link.time = timer.at;
        router.on_timer(link, timer.node, timer.tag);
    }
    /// Serves all timers that are due until `end`.
    void run(Time end) {
        while (std::any_of(link.timers.begin(), link.timers.end(),
                           [&](const auto& each) { return each.at <= end; }))
            wait();
        link.time = end;
    }
    /// Reports to the protocol that the last sent frame failed: its next hop did not acknowledge
    /// it.
    void fail_last() {
        link.go();
        link.end(router, link.sent.size() - 1, SendResult::retries);
    }
    /// Gives node `origin` a route to `to`: from `origin` over `from`, node 0 and `over`, from
    /// which there are `beyond` hops.
    void pass_reply(std::uint32_t origin, std::uint32_t from, std::uint32_t to, std::uint32_t over,
                    std::uint32_t number = 9, std::uint8_t beyond = 1) {
        hear(from,
             aodv::Request{.id = ++last_id,
                           .destination = NodeId{to},
                           .number = std::nullopt,
                           .originator = NodeId{origin},
                           .originator_number = 5},
             3);
        hear(over,
             aodv::Reply{.hops = beyond,
                         .destination = NodeId{to},
                         .number = number,
                         .originator = NodeId{origin},
                         .lifetime = std::chrono::seconds{6}},
             2);
    }
    std::optional<RouteState> route(std::uint32_t to) const {
        for (const RouteState& each : router.routes(NodeId{0}, link.time)) {
            if (each.destination == NodeId{to}) return each;
        }
        return {};
    }
    /// Packets of one kind sent so far.
    template <class Packet>
    std::vector<std::pair<Frame, Packet>> sent() const {
        std::vector<std::pair<Frame, Packet>> all;
        for (const auto& each : link.sent) {
            const Frame& frame = each.queued.frame;
            if (link.message(frame.message).uid != each.uid) continue;
            const auto packet = aodv::packet_of(link.message(frame.message).payload);
            if (const auto* p = std::get_if<Packet>(&packet)) all.emplace_back(frame, *p);
        }
        return all;
    }
    /// Frames with messages of applications sent so far.
    std::vector<Frame> data() const {
        std::vector<Frame> all;
        for (const auto& each : link.sent) {
            const Message& message = link.message(each.queued.frame.message);
            if (message.uid == each.uid && message.kind.empty()) all.push_back(each.queued.frame);
        }
        return all;
    }

    FakeLinkLayer link;
    AodvRouter router;
    std::uint32_t last_id = 1000;
};

/// Request for a destination with an unknown sequence number.
inline aodv::Request request(std::uint32_t from, std::uint32_t to, std::uint32_t id = 1,
                             std::uint32_t number = 5) {
    return {.id = id,
            .destination = NodeId{to},
            .number = std::nullopt,
            .originator = NodeId{from},
            .originator_number = number};
}

}  // namespace rovernet::test
