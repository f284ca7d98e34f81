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

/// Packets of a node that wait for a route, oldest first. The protocol holds a reference to each.
class SendBuffer {
  public:
    /// Time after which a packet is dropped, in AODV (ns-2) and DSR (RFC 4728, SendBufferTimeout).
    static constexpr Duration longest_wait = std::chrono::seconds{30};

    /// Packet that waits.
    struct Packet {
        NodeId destination;
        /// Frame as the node received it, or would receive it from its own application.
        QueuedFrame queued;
        /// Time at which it is dropped.
        Time until;
    };

    /// Adds a packet. @param most  number of packets for which there is room, at least 1
    /// @return oldest packet, which had to leave; none if there was room
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
    /// Removes the packets to a destination. @return them, oldest first
    std::vector<Packet> take(NodeId destination) {
        return take_if([&](const Packet& each) { return each.destination == destination; });
    }
    /// Removes the packets whose time has come. @return them, oldest first
    std::vector<Packet> take_expired(Time now) {
        return take_if([&](const Packet& each) { return each.until <= now; });
    }
    std::vector<Packet> take_all() {
        return take_if([](const Packet&) { return true; });
    }
    /// Earliest time at which a packet is dropped; none if the buffer is empty.
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
