// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Data of a packet at three layers: a Message (application) is stored once; a Frame refers to it
// and is copied at every hop; an AirFrame is transmitted by the radio.

namespace rovernet {

inline constexpr std::uint32_t longest_message = 65'507;  ///< largest UDP data over IPv4 [bytes]

/// Message of an application, or control packet of a routing protocol. A message does not change
/// once it is in the MessageTable.
struct Message {
    /// Node that created the message.
    NodeId origin;
    /// Unique number in the run, from 0 in the order of sending; World::new_message assigns it.
    std::uint64_t uid = 0;
    /// Number of the message among the messages of its origin, from 0; control packets of protocols
    /// are counted separately.
    std::uint32_t number = 0;
    /// Destination of the message; `everyone` for a broadcast.
    NodeId to = everyone;
    /// Key for random draws about this message, made of its origin's key and `number`: messages of
    /// other nodes do not change its draws.
    std::uint64_t key = 0;
    /// Size of the message on air [bytes], without the header that the access model adds.
    std::uint32_t size = 0;
    Time created = start_of_run;  ///< time at which the message was created
    /// Content of the message, for the receiver. The content's length may differ from `size`.
    std::string payload;
    /// Number of the application's flow, from 1; 0 for no flow. Metrics are computed for each flow.
    std::uint32_t flow = 0;
    /// Port, which selects a program of the receiver; 0 for none.
    std::uint16_t port = 0;
    /// Protocol and kind of a routing protocol's control packet, a literal: "AODV REQUEST"; empty
    /// for a message of an application.
    std::string_view kind = {};
    /// True if the routing protocol forwards the message to its destination; false if the message
    /// is sent over one hop without the protocol.
    bool is_routed = false;

    /// Protocol of a control packet, the first word of its kind: its type in ns-2 traces.
    std::string_view protocol() const { return kind.substr(0, kind.find(' ')); }
    /// Whether the message is of the link layer, below routing: "ARP REQUEST" or "ARP REPLY".
    bool is_link_packet() const { return kind.starts_with("ARP "); }
    /// Whether the message is a control packet of the routing protocol.
    bool is_routing_packet() const { return !kind.empty() && !is_link_packet(); }
    /// Whether the message is a unicast of an application that the routing protocol forwards.
    bool is_routed_unicast() const { return kind.empty() && is_routed && to != everyone; }
};

/// Number of hops, such as a time-to-live.
using Hops = std::uint16_t;

/// Copy of a message on its way: the content of one transmission. A router forwards a changed copy.
///
///   sender A --ttl 3, hops 1--> B --ttl 2, hops 2--> C --ttl 1, hops 3--> D
struct Frame {
    /// Id of the message in the frame.
    MessageId message;
    /// Node that transmits this frame.
    NodeId sender;
    /// Key of the path that the copy has taken so far, for draws about this copy. Each forwarder
    /// combines its own key into it.
    std::uint64_t path = 0;
    /// Hops that this copy may still travel, including this one.
    Hops ttl = 0;
    /// Hops that the copy has travelled at the end of this hop, including this one.
    Hops hops = 0;
    /// Receiver of this hop; `everyone` for a broadcast.
    NodeId next_hop = everyone;
    /// Size [bytes] at this hop, without the bytes that the access model adds; 0: Message::size.
    std::uint32_t bytes = 0;
    /// Header of this copy: entry in its protocol's table, from 1; 0: none. See LinkLayer::send.
    std::uint32_t header = 0;

    /// Size [bytes] of this frame: `bytes`, or the size of its message `content` if `bytes` is 0.
    std::uint32_t size_of(const Message& content) const { return bytes > 0 ? bytes : content.size; }
};

/// Header that the routing protocol puts before the message in a frame, with the bytes that go on
/// air; an address in these bytes is the id of a node.
struct FrameHeader {
    /// Protocol that made the header, by the name that Message::protocol() returns.
    std::string_view protocol;
    std::string bytes;
};

/// Frame that waits to be sent: for its send time in Routing, or for channel access in a station's
/// queue.
struct QueuedFrame {
    Frame frame;
    /// Node from which the sender received the frame; empty if the sender is the message's origin.
    std::optional<NodeId> heard_from = std::nullopt;
    /// True for a control packet of the routing protocol, which an access model with priority
    /// sends before messages of applications.
    bool is_control = false;

    /// Frame as the sender received it from the previous hop, before the sender changed it for
    /// forwarding; `frame` if the sender is the message's origin.
    Frame as_received() const {
        Frame received = frame;
        if (!heard_from) return received;
        received.sender = *heard_from;
        ++received.ttl;
        --received.hops;
        return received;
    }
};

/// Control frame of an access model: its name in traces, "RTS", and its size [bytes].
struct ControlFrame {
    std::string_view name;
    std::uint32_t bytes;
    friend bool operator==(const ControlFrame&, const ControlFrame&) = default;
};

/// Frame on air: a frame of a message (data), or a control frame of the access model.
struct AirFrame {
    /// Name of the kind of frame: "DATA", or the name of the control frame.
    std::string_view kind() const { return control ? control->name : "DATA"; }
    /// Whether the frame is a control frame with this name.
    bool is(std::string_view name) const { return control && control->name == name; }

    /// Frame of the message. In a control frame only `sender` and `next_hop` are valid.
    Frame frame = {};
    /// Node from which the sender received the frame; empty if the sender is the message's origin.
    std::optional<NodeId> heard_from = std::nullopt;
    /// Control frame, a constant of the access model; null for data.
    const ControlFrame* control = nullptr;
    /// Number of earlier transmissions of a data frame; 0 for control frames.
    std::uint8_t attempt = 0;
    /// Sequence number of a data frame, equal for all its retransmissions: a receiver detects
    /// retransmissions by this number.
    std::uint32_t number = 0;
    /// Time [ns] that the frame reserves after its end for the response: the Duration field of IEEE
    /// 802.11.
    Duration reserved{0};
};

/// Table of the messages that a frame in flight or a waiting copy refers to, with reference counts.
/// Every stored MessageId counts as a reference: hold() when it is copied, release() when it is
/// dropped. The slot is reused after the last release; World::release then notifies the routing
/// protocol.
class MessageTable {
  public:
    /// Stores a message with one reference, the caller's.
    MessageId add(Message message);
    /// Adds a reference to the message.
    void hold(MessageId id) { ++slots_[id.index()].holders; }
    /// Removes a reference; the last one frees the slot. @return whether the slot was freed
    bool release(MessageId id) {
        assert(slots_[id.index()].holders > 0);
        if (--slots_[id.index()].holders > 0) return false;
        free_.push_back(id);
        return true;
    }

    /// Message with this id, which must be in use; the reference is valid until the next add().
    const Message& operator[](MessageId id) const { return slots_[id.index()].message; }
    /// Marks the message as having had a frame that ended at a receiver.
    void mark_ended(MessageId id) { slots_[id.index()].has_ended = true; }
    /// Notes that a node has received the message as its next hop. A message stays at its
    /// destination, whatever becomes of further copies.
    void pass_to(MessageId id, NodeId node) {
        Slot& slot = slots_[id.index()];
        if (slot.at != slot.message.to) slot.at = node;
    }
    /// Notes a frame that the routing protocol sends; the first one sets first_ttl().
    void note_sending(const Frame& frame) {
        Hops& ttl = slots_[frame.message.index()].first_ttl;
        if (ttl == 0) ttl = frame.ttl;
    }
    /// TTL of the first frame of a message; 0 if the message has no frame yet.
    Hops first_ttl(MessageId id) const { return slots_[id.index()].first_ttl; }
    /// Node that received the message last as its next hop; at first the message's origin.
    NodeId at(MessageId id) const { return slots_[id.index()].at; }
    /// Messages on their way, in order of id, each with the node that has the message: messages of
    /// which no frame has ended at any receiver, and messages that a protocol has not yet brought
    /// to their destination, one robot. At the end of a run both are reported as cut off or held.
    std::vector<std::pair<MessageId, NodeId>> on_their_way() const;
    /// Number of messages in use.
    std::size_t size() const { return slots_.size() - free_.size(); }
    /// Upper bound on ids: the index of every MessageId so far is below this number.
    std::size_t capacity() const { return slots_.size(); }

  private:
    // Slot: message, number of its references, whether a frame of the message has ended, TTL of
    // its first frame, and the last node that received it as its next hop (at first its origin).
    struct Slot {
        Message message;
        std::uint32_t holders = 0;
        bool has_ended = false;
        Hops first_ttl = 0;
        NodeId at{};
    };
    // Slots of the table, by MessageId.
    std::vector<Slot> slots_;
    // Free slots; the last one is reused first.
    std::vector<MessageId> free_;
};

}  // namespace rovernet
