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
    /// Transmits an ARP packet, or a frame whose next hop's address was just resolved. The user
    /// takes over the frame's reference to its message.
    virtual void send_resolved(const QueuedFrame& frame) = 0;
    /// Called when a waiting frame is dropped: a later frame replaced the waiting frame
    /// (`is_displaced` is true), or no request for the address was answered (false).
    virtual void unresolved(const QueuedFrame& frame, bool is_displaced) = 0;

  protected:
    ~ArpUser() = default;
};

/// Address resolution (ARP) between the routing layer and the MAC: RFC 826, with the queue of ns-2.
/// A unicast to a next hop whose address is unknown waits, and a request of 28 bytes is broadcast.
/// One frame waits for each next hop: a later frame replaces the waiting frame, and causes another
/// request. Three seconds without an answer also cause another request. After three requests
/// without an answer, the waiting frame is dropped.
class Arp {
  public:
    static constexpr std::uint8_t most_requests = 3;
    static constexpr Duration answer_time = std::chrono::seconds{3};

    Arp(World& world, ArpUser& user, const ArpSettings& settings)
        : world_(world), user_(user), timeout_(settings.arp_timeout) {}

    /// Whether the sender of a unicast knows the address of its next hop. If not, Arp stores the
    /// frame with its reference until the address is known, and broadcasts a request.
    bool admits(const QueuedFrame& frame);
    /// Handles a received ARP packet: each receiver stores the sender's address, and the node whose
    /// address is requested answers. Sets the fate of each reception.
    void receive(const Frame& frame, std::span<Reception> receptions);
    /// Serves the event of the entry for `next_hop` in the ARP table of `node`. If the address is
    /// known, sends the waiting frame and a pending answer; otherwise sends the next request.
    void on_timer(NodeId node, NodeId next_hop);
    /// Removes and returns the frame of `node` that waits for the address of `next_hop`; empty if
    /// no frame waits for which `is_taken` is true. See LinkLayer::take_queued.
    std::optional<QueuedFrame> take(NodeId node, NodeId next_hop, const FrameTest& is_taken);
    /// Clears the ARP table of a node that was switched off. @return frames that waited in the
    /// table
    std::vector<QueuedFrame> switch_off(NodeId node);

  private:
    /// Entry of a node's ARP table: state of the resolution of one neighbour's address.
    struct Entry {
        NodeId neighbour;
        /// Time until which the neighbour's address is valid; in the past if the address is
        /// unknown.
        Time until;
        /// Time of the entry's next event, see on_timer; events of the entry at other times are
        /// ignored.
        Time due = never;
        /// Number of requests for the neighbour's address since the last packet from the neighbour.
        std::uint8_t requests = 0;
        /// Whether the neighbour has requested the node's address, and the node has not yet
        /// answered.
        bool owes_reply = false;
        /// Frame that waits for the neighbour's address; empty if no frame waits.
        std::optional<QueuedFrame> held = std::nullopt;
    };
    Entry* find(NodeId node, NodeId neighbour);
    Entry& add(NodeId node, NodeId neighbour);
    bool is_known(const Entry& entry) const;
    // Sends a request for the entry's address; after three requests, drops the waiting frame
    // instead.
    void ask(NodeId node, Entry& entry);
    // Records that `node` knows the address of the entry's neighbour from `time` on.
    void learn(Entry& entry, NodeId node, Time time);
    void set_event(Entry& entry, NodeId node, Time due);
    void send(NodeId from, NodeId to, NodeId next_hop, std::string_view kind);

    World& world_;
    ArpUser& user_;
    std::optional<Duration> timeout_;
    // ARP table of each node: entries in the order of the neighbours' ids.
    std::vector<std::vector<Entry>> entries_;
    // Number of ARP packets that each node has sent so far.
    std::vector<std::uint32_t> packets_;
};

}  // namespace rovernet
