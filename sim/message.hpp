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

// From what an application says to what is on air: a Message is stored once, a Frame refers to it
// and is copied at every hop, an AirFrame is what the radio sends.

namespace rovernet {

/// Message of an application, or packet of a routing protocol. It does not change once it is in the
/// table.
struct Message {
    /// Node that made it.
    NodeId origin;
    /// Number that is unique in the run, from 0 in the order of sending; World::new_message gives
    /// it.
    std::uint64_t uid = 0;
    /// Number among the messages of its origin, from 0; packets of protocols have their own count.
    std::uint32_t number = 0;
    /// Destination; `everyone` for a broadcast.
    NodeId to = everyone;
    /// Key for random draws that concern it, made of its origin's key and `number`: messages of
    /// others change no draw of this one.
    std::uint64_t key = 0;
    /// Size [bytes] on air, without what the access model adds.
    std::uint32_t size = 0;
    /// Time at which it was made.
    Time created = start_of_run;
    /// Content, for whoever receives it. Its length may differ from `size`.
    std::string payload;
    /// Flow of the application that it belongs to, from 1; 0: none. Metrics are told by flow.
    std::uint32_t flow = 0;
    /// Kind of a routing protocol's own packet, as a trace names it, a literal; empty: a message of
    /// an application.
    std::string_view kind = {};
    /// The routing protocol brings it to its destination; otherwise it goes over one hop, past the
    /// protocol.
    bool is_routed = false;
};

/// Number of hops, such as a time-to-live.
using Hops = std::uint16_t;

/// Copy of a message on its way: what one transmission carries. It is a value: a router passes on a
/// changed copy.
///
///   sender A --ttl 3, hops 1--> B --ttl 2, hops 2--> C --ttl 1, hops 3--> D
struct Frame {
    /// Message that it carries.
    MessageId message;
    /// Node that puts this frame on air.
    NodeId sender;
    /// Key of the walk that the copy took so far, for draws that concern this copy. Each forwarder
    /// combines its own key into it.
    std::uint64_t path = 0;
    /// Hops that this copy may still cross, this one included.
    Hops ttl = 0;
    /// Hops that it has crossed once it is received.
    Hops hops = 0;
    /// Receiver of this hop; `everyone` for a broadcast.
    NodeId next_hop = everyone;
};

/// Frame that waits to be sent: for its time in Routing, for access in a station's queue.
struct QueuedFrame {
    Frame frame;
    /// Node that the sender received it from; nothing if the sender is its origin.
    std::optional<NodeId> heard_from;
};

/// Frame as it is on air: that of a message, or a control frame of the access model (IEEE 802.11:
/// RTS, CTS, ACK).
struct AirFrame {
    /// Kind of a frame: of a message, or request to send, clear to send, acknowledgement.
    enum Kind : std::uint8_t { data, rts, cts, ack };

    /// Frame of the message. Of a control frame `sender` and `next_hop` mean something, nothing
    /// else.
    Frame frame = {};
    /// Node that the sender received it from, as in QueuedFrame.
    std::optional<NodeId> heard_from = std::nullopt;
    Kind kind = data;
    /// Number of times that a data frame was sent before; 0 for control frames.
    std::uint8_t attempt = 0;
    /// Number of a data frame, the same for all attempts at it: a receiver knows a repetition by
    /// it.
    std::uint32_t number = 0;
    /// Time [ns] after its end that it reserves for the answers to it: the Duration field of IEEE
    /// 802.11.
    Duration reserved{0};
};

/// Messages that a frame in flight or a waiting copy still refers to, counted by reference.
///
/// Whoever keeps a MessageId holds the message: hold() when it is copied, release() when it is
/// dropped. The slot is used again after the last release; World::release tells the routing
/// protocol of that.
class MessageTable {
  public:
    /// Stores a message, held once by the caller.
    MessageId add(Message message);
    /// Counts one more frame or waiting copy of the message.
    void hold(MessageId id) { ++slots_[id.index()].holders; }
    /// Counts one fewer; the last one frees the slot. @return whether the message is gone
    bool release(MessageId id) {
        assert(slots_[id.index()].holders > 0);
        if (--slots_[id.index()].holders > 0) return false;
        free_.push_back(id);
        return true;
    }

    /// Message in that slot, which must be held; the reference is good until the next add().
    const Message& operator[](MessageId id) const { return slots_[id.index()].message; }
    /// Notes that a frame of the message has arrived somewhere.
    void arrived(MessageId id) { slots_[id.index()].has_arrived = true; }
    /// Calls visit(id) for every message that is held and has arrived nowhere, in order of id. At
    /// the end of a run these are told of as cut off.
    template <class Visit>
    void for_each_at_its_origin(Visit visit) const {
        for (MessageId id{0}; id.index() < slots_.size(); ++id.value) {
            const Slot& slot = slots_[id.index()];
            if (slot.holders > 0 && !slot.has_arrived) visit(id);
        }
    }
    /// Number of messages that are held.
    std::size_t size() const { return slots_.size() - free_.size(); }
    /// Bound on ids: the index of every MessageId so far is below it.
    std::size_t capacity() const { return slots_.size(); }

  private:
    // Message, how many hold it, and whether a frame of it has ended anywhere.
    struct Slot {
        Message message;
        std::uint32_t holders = 0;
        bool has_arrived = false;
    };
    // Slots by MessageId.
    std::vector<Slot> slots_;
    // Slots that are free, the last one first.
    std::vector<MessageId> free_;
};

}  // namespace rovernet
