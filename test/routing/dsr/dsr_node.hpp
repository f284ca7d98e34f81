// SPDX-License-Identifier: MIT
#pragma once

#include "routing/dsr/dsr_router.hpp"
#include "test/routing/fake_link_layer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

using dsr::Path;

inline Path path(std::initializer_list<std::uint32_t> nodes) {
    Path made;
    for (const std::uint32_t node : nodes) made.add(NodeId{node});
    return made;
}
inline std::vector<std::uint32_t> values(const Path& path) {
    std::vector<std::uint32_t> all;
    for (const NodeId node : path) all.push_back(node.value);
    return all;
}
using Nodes = std::vector<std::uint32_t>;

/// DSR router whose node 0 is tested, and functions by which a test acts as the other nodes.
struct DsrNode {
    explicit DsrNode(Dsr dsr = {}, std::size_t nodes = 40) : link(nodes), router(dsr) {
        link.on_forgotten = [this](MessageId id) { router.forget(id); };
        link.on_header_forgotten = [this](std::uint32_t header) { router.forget_header(header); };
    }

    /// Passes a packet to node `at`. @return fate of the packet
    Fate hear(const Frame& frame, const dsr::Packet& packet, std::uint32_t from, std::uint32_t to,
              std::string_view kind, std::uint32_t at = 0) {
        const MessageId id =
            link.originate(NodeId{from}, NodeId{to}, kind, 24, dsr::to_bytes(packet));
        Frame copy = frame;
        copy.message = id;
        const auto got = link.arrive(router, copy, {at});
        link.release(id);
        return got[0].fate;
    }
    /// Passes to node 0 a request that `nodes` have forwarded; the first node is its originator.
    Fate request(const Path& nodes, std::uint32_t target, std::uint16_t id = 1, Hops ttl = 10,
                 std::optional<dsr::Error> error = {}) {
        return hear({.message = {}, .sender = nodes.back(), .ttl = ttl, .hops = 1},
                    {.request = dsr::Request{id, NodeId{target}, nodes}, .error = error},
                    nodes.front().value, target, dsr::request_kind);
    }
    /// Passes to node `at` a reply that travels along `back`, sent by the node with index `place`.
    Fate reply(const Path& route, const Path& back, std::size_t place, std::uint32_t at = 0) {
        return hear({.message = {},
                     .sender = back[place],
                     .ttl = 20,
                     .hops = static_cast<Hops>(place + 1),
                     .next_hop = back[place + 1]},
                    {.reply = dsr::Reply{route}, .route = back}, back.front().value,
                    back.back().value, dsr::reply_kind, at);
    }
    /// Gives the first node of a route this route, by a reply of the last node.
    void learn(const Path& route) {
        const Path back = route.reversed();
        reply(route, back, back.size() - 2, route.front().value);
    }
    /// Passes to node `at` a route error that travels along `back`, sent by the node with index
    /// `place`.
    Fate error(const dsr::Error& error, const Path& back, std::size_t place, std::uint32_t at = 0) {
        return hear({.message = {},
                     .sender = back[place],
                     .ttl = 20,
                     .hops = static_cast<Hops>(place + 1),
                     .next_hop = back[place + 1]},
                    {.error = error, .route = back}, back.front().value, back.back().value,
                    dsr::error_kind, at);
    }
    MessageId send(std::uint32_t to, std::uint32_t from = 0) {
        const MessageId id = link.message_from(NodeId{from}, NodeId{to}, std::string(64, 'x'));
        router.send(link, NodeId{from}, id);
        link.release(id);
        return id;
    }
    /// Delivers the last sent message to its next hop, or to node `at`.
    Reception arrive(std::optional<std::uint32_t> at = {}) {
        const Frame frame = link.go();
        return link.arrive(router, frame, {at.value_or(frame.next_hop.value)})[0];
    }
    /// Reports to the protocol that the last sent frame did not reach its next hop.
    void fail() {
        link.go();
        link.end(router, link.sent.size() - 1, SendResult::retries);
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
    /// Route to `to` that node `at` knows; empty if it knows no route.
    Nodes route(std::uint32_t to, std::uint32_t at = 0) const {
        for (const RouteState& each : router.routes(NodeId{at}, link.time)) {
            Nodes all;
            for (const NodeId node : each.path) all.push_back(node.value);
            if (each.destination == NodeId{to}) return all;
        }
        return {};
    }
    /// Text of the Source Route option in a frame's header, decoded by RFC 4728, 6.7: "1 2, salvage
    /// 0, left 1".
    std::string route_on_air(const Frame& frame) const {
        const FrameHeader header = router.header_bytes(frame);
        CHECK(header.protocol == "DSR");
        CHECK(header.bytes.size() + 20 == frame.bytes);  // messages of FakeLinkLayer have size 0
        const auto byte = [&](std::size_t at) {
            return static_cast<std::uint8_t>(header.bytes[at]);
        };
        std::string text;
        for (std::size_t at = 8; at < header.bytes.size(); at += 4) {
            text += std::to_string(byte(at + 3)) + ' ';
        }
        if (!text.empty()) text.pop_back();
        return text + ", salvage " + std::to_string((byte(6) & 3) << 2 | byte(7) >> 6) + ", left " +
               std::to_string(byte(7) & 63);
    }
    /// Control packets of one kind sent so far.
    std::vector<std::pair<Frame, dsr::Packet>> sent(std::string_view kind) const {
        std::vector<std::pair<Frame, dsr::Packet>> all;
        for (const auto& each : link.sent) {
            const Message& message = link.message(each.queued.frame.message);
            if (message.kind == kind) all.emplace_back(each.queued.frame, dsr::packet_of(message));
        }
        return all;
    }
    /// Frames with messages of applications sent so far.
    std::vector<Frame> data() const {
        std::vector<Frame> all;
        for (const auto& each : link.sent) {
            if (link.message(each.queued.frame.message).kind.empty())
                all.push_back(each.queued.frame);
        }
        return all;
    }

    FakeLinkLayer link;
    DsrRouter router;
};

}  // namespace rovernet::test
