// SPDX-License-Identifier: MIT
#include "models/access/aloha.hpp"

#include <algorithm>
#include <utility>

namespace rovernet {

std::unique_ptr<Access> Aloha::make_access() const { return std::make_unique<AlohaAccess>(*this); }

void AlohaAccess::send(Air& air, const QueuedFrame& frame) {
    const NodeId node = frame.frame.sender;
    auto& queue = stations_[node.index()].queue;
    if (queue.size() >= static_cast<std::size_t>(settings_.queue))
        return air.lost(frame, DropReason::queue_full);
    queue.push_back(frame);
    if (queue.size() == 1) expect(air, node);
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
    if (s.queue.empty()) return;  // switched off since
    const QueuedFrame frame = s.queue.front();
    s.queue.erase(s.queue.begin());
    s.free_from = air.transmit({.frame = frame.frame, .heard_from = frame.heard_from});
    if (!s.queue.empty()) expect(air, node);
    air.sent(frame);
}

std::vector<QueuedFrame> AlohaAccess::take(NodeId node, NodeId next_hop) {
    return take_waiting(stations_[node.index()].queue, next_hop);
}

void AlohaAccess::switch_off(Air& air, NodeId node) {
    auto lost = std::exchange(stations_[node.index()].queue, {});
    for (const QueuedFrame& frame : lost) air.lost(frame, DropReason::end);
}

}  // namespace rovernet
