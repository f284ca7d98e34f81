// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/link_layer.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"

#include <algorithm>
#include <span>

// Functions that all flooding protocols share: the copy that a relay sends, and the order of
// relays.

namespace rovernet {

/// Frame as forwarded by `node`, which has received `frame`.
inline QueuedFrame passed_on(const LinkLayer& link, const Frame& frame, NodeId node) {
    return {{.message = frame.message,
             .sender = node,
             .path = combine(frame.path, link.key(node)),
             .ttl = static_cast<Hops>(frame.ttl - 1),
             .hops = static_cast<Hops>(frame.hops + 1)},
            frame.sender};
}

/// Sorts receptions of a frame by time, then by the keys of their nodes. Frames with the same send
/// time are sent in the order in which they were passed to the link layer; after this sort, the ids
/// of nodes have no effect on the order.
inline void sort_by_keys(const LinkLayer& link, std::span<Reception*> receptions) {
    for (const Reception* each : receptions) link.prefetch(each->node);
    if (receptions.size() < 2) return;
    std::sort(receptions.begin(), receptions.end(), [&](const auto* a, const auto* b) {
        return a->time != b->time ? a->time < b->time : link.key(a->node) < link.key(b->node);
    });
}

}  // namespace rovernet
