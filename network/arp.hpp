// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

struct World;

/// Interface of the layer that uses ARP. Routing implements it.
class ArpUser {
  public:
    /// Transmits an ARP packet, or a frame whose next hop is resolved now. The frame has a
    /// reference to its message, which passes to the user.
    virtual void send_resolved(const QueuedFrame& frame) = 0;
    /// Called when a frame is given up: a later frame took its place (`is_displaced`), or nobody
    /// answered.
    virtual void unresolved(const QueuedFrame& frame, bool is_displaced) = 0;

  protected:
    ~ArpUser() = default;
};

/// Address resolution between the routing layer and the MAC: RFC 826, with the queue of ns-2. A
/// unicast to a next hop whose address is unknown waits, one frame for each next hop, and a request
/// of 28 B asks everyone in range. A later frame takes the place of the waiting one, and asks
/// again; so does the waiting frame itself after three seconds. After three requests without an
/// answer, the frame is given up.
class Arp {
  public:
    static constexpr std::uint8_t most_requests = 3;
    static constexpr Duration answer_time = std::chrono::seconds{3};

    Arp(World& world, ArpUser& user, const ArpSettings& settings)
        : world_(world), user_(user), timeout_(settings.arp_timeout) {}

    /// Whether the sender of a unicast knows the address of its next hop. If not, the frame waits
    /// here, with its reference.
    bool admits(const QueuedFrame& frame);
    /// Serves ARP packets: teaches the receivers, and answers requests for their addresses. Sets
    /// the fates.
    void receive(const Frame& frame, std::span<Reception> receptions);
    /// Serves the event of a neighbour's entry: what its answer has set free is sent, or the next
    /// request.
    void on_timer(NodeId node, NodeId next_hop);
    /// Removes the frame that waits for the address of `next_hop`, see LinkLayer::take_queued.
    std::optional<QueuedFrame> take(NodeId node, NodeId next_hop);
    /// Clears the addresses and frames of a node that was switched off. @return the frames
    std::vector<QueuedFrame> switch_off(NodeId node);

  private:
    /// Neighbour of a node, as far as the node has resolved its address.
    struct Entry {
        NodeId neighbour;
        /// End of the address's validity; in the past while it is unknown.
        Time until;
        /// Time of the entry's valid event, see on_timer.
        Time due = never;
        /// Number of requests without an answer.
        std::uint8_t requests = 0;
        /// Whether the neighbour has asked for the node's address, and has no answer yet.
        bool owes_reply = false;
        /// Frame that waits for the address.
        std::optional<QueuedFrame> held = std::nullopt;
    };
    Entry* find(NodeId node, NodeId neighbour);
    Entry& add(NodeId node, NodeId neighbour);
    bool is_known(const Entry& entry) const;
    // Sends a request for an address, or gives up the frame that waits for it.
    void ask(NodeId node, Entry& entry);
    // Notes the address of a neighbour, which the node has received at `time`.
    void learn(Entry& entry, NodeId node, Time time);
    void set_event(Entry& entry, NodeId node, Time due);
    void send(NodeId from, NodeId to, NodeId next_hop, std::string_view kind);

    World& world_;
    ArpUser& user_;
    std::optional<Duration> timeout_;
    // Neighbours of each node, in the order of their ids.
    std::vector<std::vector<Entry>> entries_;
    // Number of ARP packets that each node has sent so far.
    std::vector<std::uint32_t> packets_;
};

}  // namespace rovernet
