// SPDX-License-Identifier: MIT
#pragma once

#include "sim/link_layer.hpp"
#include "sim/router.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace rovernet {

/// Adapter that lets a flooding protocol carry messages for one robot. All robots receive and
/// forward the message. Only the destination delivers the message to its application.
class ToDestination {
  public:
    explicit ToDestination(Router protocol) : protocol_(std::move(protocol)) {}

    /// Traits of the protocol, which routes unicasts by this adapter.
    RouterTraits traits() const {
        RouterTraits traits = protocol_.traits();
        traits.routes_unicasts = true;
        return traits;
    }
    Hops initial_ttl() const { return protocol_.initial_ttl(Message{}); }
    Hops initial_ttl(const Message& message) const { return protocol_.initial_ttl(message); }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        protocol_.send(link, node, message);
    }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        protocol_.on_receive(link, frame, receptions);
        const NodeId to = link.message(frame.message).to;
        if (to == everyone) return;
        for (Reception& each : receptions) each.delivered = each.delivered && each.node == to;
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        protocol_.on_timer(link, node, tag);
    }
    bool hears_of_results() const { return protocol_.hears_of_results(); }
    void on_sent(LinkLayer& link, const QueuedFrame& frame, SendResult result) {
        protocol_.on_sent(link, frame, result);
    }
    void on_start(LinkLayer& link, NodeId node) { protocol_.on_start(link, node); }
    void on_switched(LinkLayer& link, NodeId node, bool on) {
        protocol_.on_switched(link, node, on);
    }
    void forget(MessageId message) { protocol_.forget(message); }
    void forget_header(std::uint32_t header) { protocol_.forget_header(header); }
    bool keeps(MessageId message) const { return protocol_.keeps(message); }
    void describe(const Message& message, const Frame& frame, PacketStyle style,
                  std::string& text) const {
        protocol_.describe(message, frame, style, text);
    }

  private:
    Router protocol_;
};

/// Protocol that also carries messages for one robot: `protocol` itself if it routes unicasts, or
/// else `protocol` wrapped in ToDestination.
inline Router to_destinations(Router protocol) {
    if (protocol.traits().routes_unicasts) return protocol;
    return ToDestination(std::move(protocol));
}

}  // namespace rovernet
