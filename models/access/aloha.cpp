// SPDX-License-Identifier: MIT
#include "models/access/aloha.hpp"

#include "models/access/transmit_queue.hpp"
#include "models/phy/wifi.hpp"

#include <algorithm>
#include <vector>

namespace rovernet {

/// Queues and transmissions of all nodes under ALOHA.
class AlohaAccess final : public Access {
  public:
    /// @param settings  settings, as given
    explicit AlohaAccess(const Aloha& settings) : settings_(settings) {}

    void add() override { stations_.emplace_back(); }
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, const FrameTest& is_taken) override;
    std::size_t queued(NodeId node) const override { return stations_[node.index()].queue.size(); }
    void switch_off(Air& air, NodeId node) override;
    Phy phy() const override { return Wifi{}; }
    bool has_priority() const override { return settings_.priority; }

  private:
    /// State of one node: its queue, and the end of its last frame.
    struct Station {
        /// End of the node's last frame: the next one starts no earlier.
        Time free_from = start_of_run;
        /// Frames that wait at the node; a timer is set for the first.
        TransmitQueue queue = {};
    };
    // Sets the timer for the first frame of the queue.
    void expect(Air& air, NodeId node);

    // Settings, as given.
    Aloha settings_;
    // Stations by node.
    std::vector<Station> stations_;
};

std::unique_ptr<Access> Aloha::make_access() const { return std::make_unique<AlohaAccess>(*this); }

void AlohaAccess::send(Air& air, const QueuedFrame& frame) {
    const NodeId node = frame.frame.sender;
    TransmitQueue& queue = stations_[node.index()].queue;
    const bool waits = !queue.empty();
    const auto refused =
        queue.push(frame, static_cast<std::size_t>(settings_.queue), settings_.priority);
    if (refused) return air.lost(*refused, DropReason::queue_full);
    if (!waits) expect(air, node);
}

/// Sets the timer for the first frame of the queue.
void AlohaAccess::expect(Air& air, NodeId node) {
    Time begin = std::max(air.now(), stations_[node.index()].free_from);
    const Duration slot = settings_.slot.value_or(Duration{0});
    if (slot > Duration{0}) {
        const Duration into = begin.time_since_epoch() % slot;
        if (into > Duration{0}) begin += slot - into;
    }
    air.access_timer(node, begin, 0);
}

void AlohaAccess::on_timer(Air& air, NodeId node, std::uint32_t /*tag*/) {
    Station& s = stations_[node.index()];
    // Frames may have been taken since, or another timer was earlier.
    if (s.queue.empty() || air.now() < s.free_from) return;
    const QueuedFrame frame = s.queue.front();
    s.free_from = air.transmit({.frame = frame.frame, .heard_from = frame.heard_from});
    s.queue.pop();
    if (!s.queue.empty()) expect(air, node);
    air.sent(frame);
}

std::vector<QueuedFrame> AlohaAccess::take(NodeId node, const FrameTest& is_taken) {
    return stations_[node.index()].queue.take(is_taken, false);
}

void AlohaAccess::switch_off(Air& air, NodeId node) {
    for (const QueuedFrame& frame : stations_[node.index()].queue.take_all()) {
        air.lost(frame, DropReason::end);
    }
}

}  // namespace rovernet
