// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// What an application sends. Immutable once in the table.
struct Message {
    NodeId origin;
    std::uint64_t uid = 0;     ///< unique in the run, from 0 in the order of sending
    std::uint32_t number = 0;  ///< the origin's own count of messages, from 0
    NodeId to = everyone;      ///< who it is for
    std::uint64_t key = 0;     ///< for random draws: made of the origin's key and `number`
    std::uint32_t size = 0;    ///< [bytes] on air
    Time created = start_of_run;
    std::string payload;
    std::uint32_t flow = 0;  ///< of the application, from 1; 0: of none
    /// Kind of a routing protocol's own packet, a literal; empty: an application's message.
    std::string_view kind = {};
    bool is_routed = false;  ///< it goes by the routing protocol, not over one hop beside it
};

/// A number of hops, such as a time-to-live.
using Hops = std::uint16_t;

/// A message on its way: what one transmission carries. A value; routers pass it on changed.
struct Frame {
    MessageId message;
    NodeId sender;               ///< who puts this frame on air
    std::uint64_t path = 0;      ///< key of the walk that the copy took so far, for draws per copy
    Hops ttl = 0;                ///< the hops that this copy may still cross, this one included
    Hops hops = 0;               ///< the hops that it has crossed once received
    NodeId next_hop = everyone;  ///< who it is for
};

/// A frame that its sender is about to send.
struct QueuedFrame {
    Frame frame;
    std::optional<NodeId> heard_from;  ///< who the sender received it from, if it forwards it
};

/// A frame as it is on air, that of a message or one that only controls access.
struct AirFrame {
    enum Kind : std::uint8_t { data, rts, cts, ack };

    Frame frame = {};  ///< of control frames sender and next_hop only
    std::optional<NodeId> heard_from = std::nullopt;  ///< who its sender had it from
    Kind kind = data;
    std::uint8_t attempt = 0;  ///< of data: how often it was sent before
    std::uint32_t number = 0;  ///< of data: the same for all attempts at one frame
    Duration reserved{0};      ///< [ns] after its end for what belongs to it
};

/// The messages that a frame in flight or a waiting copy still refers to.
class MessageTable {
  public:
    /// Stores a message, held once by the caller.
    MessageId add(Message message);
    /// One more frame or waiting copy refers to the message.
    void hold(MessageId id) { ++slots_[id.index()].holders; }
    /// One fewer; the last one frees the slot. True if the message is gone.
    bool release(MessageId id) {
        assert(slots_[id.index()].holders > 0);
        if (--slots_[id.index()].holders > 0) return false;
        free_.push_back(id);
        return true;
    }

    const Message& operator[](MessageId id) const { return slots_[id.index()].message; }
    /// A frame of the message has arrived somewhere.
    void arrived(MessageId id) { slots_[id.index()].has_arrived = true; }
    /// Calls visit(id) for every message that is held and has arrived nowhere, in order of id.
    template <class Visit>
    void for_each_at_its_origin(Visit visit) const {
        for (MessageId id{0}; id.index() < slots_.size(); ++id.value) {
            const Slot& slot = slots_[id.index()];
            if (slot.holders > 0 && !slot.has_arrived) visit(id);
        }
    }
    /// Messages still held.
    std::size_t size() const { return slots_.size() - free_.size(); }
    /// Every MessageId's index is below this.
    std::size_t capacity() const { return slots_.size(); }

  private:
    struct Slot {
        Message message;
        std::uint32_t holders = 0;
        bool has_arrived = false;
    };
    std::vector<Slot> slots_;
    std::vector<MessageId> free_;
};

}  // namespace rovernet
