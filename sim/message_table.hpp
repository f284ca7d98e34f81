// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {

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
    /// Calls visit(id, node) for every message in use that is on its way, in order of id; `node`
    /// has the message. On its way is a message of which no frame has ended at any receiver, and a
    /// message that a protocol brings to one robot, until it is there. At the end of a run these
    /// messages are reported as cut off or held.
    template <class Visit>
    void for_each_on_its_way(Visit visit) const {
        for (MessageId id{0}; id.index() < slots_.size(); ++id.value) {
            const auto& [message, holders, has_ended, at] = slots_[id.index()];
            const bool is_brought =
                message.is_routed && message.to != everyone && !message.is_routing_packet();
            if (holders > 0 && (is_brought ? at != message.to : !has_ended)) visit(id, at);
        }
    }
    /// Number of messages in use.
    std::size_t size() const { return slots_.size() - free_.size(); }
    /// Upper bound on ids: the index of every MessageId so far is below this number.
    std::size_t capacity() const { return slots_.size(); }

  private:
    // Slot: message, number of its references, whether a frame of the message has ended, and the
    // last node that received it as its next hop (at first its origin).
    struct Slot {
        Message message;
        std::uint32_t holders = 0;
        bool has_ended = false;
        NodeId at{};
    };
    // Slots of the table, by MessageId.
    std::vector<Slot> slots_;
    // Free slots; the last one is reused first.
    std::vector<MessageId> free_;
};

}  // namespace rovernet
