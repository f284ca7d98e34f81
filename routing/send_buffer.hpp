// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

namespace rovernet {

/// Packets of a node that wait for a route, oldest first. The routing protocol holds a reference to
/// the message of each packet.
class SendBuffer {
  public:
    /// Time after which a packet is dropped, in AODV (ns-2) and DSR (RFC 4728, SendBufferTimeout).
    static constexpr Duration longest_wait = std::chrono::seconds{30};

    /// Packet that waits for a route.
    struct Packet {
        NodeId destination;
        /// Frame that the node sends once it has a route; the next hop is set then.
        QueuedFrame queued;
        /// Time at which the packet is dropped.
        Time until;
    };

    /// Adds a packet. If the buffer is full, removes the oldest packet.
    /// @param most  capacity of the buffer [packets], at least 1
    /// @return removed packet; empty if there was space
    std::optional<Packet> add(const Packet& packet, std::size_t most) {
        std::optional<Packet> oldest;
        if (packets_.size() >= most) {
            oldest = packets_.front();
            packets_.erase(packets_.begin());
        }
        packets_.push_back(packet);
        return oldest;
    }
    bool has(NodeId destination) const {
        return std::any_of(packets_.begin(), packets_.end(),
                           [&](const Packet& each) { return each.destination == destination; });
    }
    /// Removes the packets to a destination. @return removed packets, oldest first
    std::vector<Packet> take(NodeId destination) {
        return take_if([&](const Packet& each) { return each.destination == destination; });
    }
    /// Removes the packets that are to be dropped by `now`. @return removed packets, oldest first
    std::vector<Packet> take_expired(Time now) {
        return take_if([&](const Packet& each) { return each.until <= now; });
    }
    std::vector<Packet> take_all() {
        return take_if([](const Packet&) { return true; });
    }
    /// Earliest time at which a packet is dropped; empty if the buffer has no packets.
    std::optional<Time> first_end() const {
        if (packets_.empty()) return std::nullopt;
        return std::min_element(packets_.begin(), packets_.end(),
                                [](const Packet& a, const Packet& b) { return a.until < b.until; })
            ->until;
    }
    const std::vector<Packet>& packets() const { return packets_; }

  private:
    template <class Condition>
    std::vector<Packet> take_if(Condition condition) {
        std::vector<Packet> taken;
        if (std::none_of(packets_.begin(), packets_.end(), condition)) return taken;
        std::copy_if(packets_.begin(), packets_.end(), std::back_inserter(taken), condition);
        std::erase_if(packets_, condition);
        return taken;
    }

    std::vector<Packet> packets_;
};

}  // namespace rovernet
