// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

// Pure and slotted ALOHA: the simplest access that has a queue. In code:
//
//     Network network({.access = Aloha{.slot = 1ms}});

namespace rovernet {

/// Settings of ALOHA.
struct Aloha {
    static constexpr std::string_view name = "aloha";

    /// Slot [ns]: frames begin at its multiples (slotted ALOHA); 0: at once (pure ALOHA).
    Duration slot{0};
    /// Frames that wait at a node at most, the one that is next included; one more is dropped.
    std::uint32_t queue = 50;

    /// Model at work, for one Network.
    std::unique_ptr<Access> make_access() const;
};

/// Access model "aloha": a frame goes on air at once, or with the next slot, whatever others do;
/// only a node's own frames wait for one another.
///
///   pure      |==1==|==2==|   |==3==|       a frame that comes in the meantime waits for the last
///   slotted   |==1==|   |==2==|   |==3==|   frames begin at multiples of the slot
///
/// A unicast is sent once: nobody acknowledges it. With many senders of total load G, in frames per
/// frame time, a share of e^-2G gets through, slotted e^-G; bench/aloha.hpp measures that.
///
/// Source: N. Abramson, The ALOHA system, AFIPS 1970; L. Roberts, ALOHA packet system with and
/// without slots and capture, 1975.
class AlohaAccess final : public Access {
  public:
    /// @param settings  as they were given
    explicit AlohaAccess(const Aloha& settings) : settings_(settings) {}

    void add() override { stations_.emplace_back(); }
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) override;
    void switch_off(Air& air, NodeId node) override;

  private:
    /// State of one node.
    struct Station {
        /// End of its own last frame.
        Time free_from = start_of_run;
        /// Frames that wait; the first has a timer.
        std::vector<QueuedFrame> queue = {};
    };
    // Sets the timer for the first frame of the queue.
    void expect(Air& air, NodeId node);

    // Settings as they were given.
    Aloha settings_;
    // Stations by node.
    std::vector<Station> stations_;
};

}  // namespace rovernet
