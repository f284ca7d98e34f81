// SPDX-License-Identifier: MIT
#pragma once

#include "sim/link_layer.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace rovernet {

/// Receptions in the order in which a routing protocol serves them: by time, then by the keys of
/// their nodes, so that the ids of nodes have no effect.
inline std::vector<Reception*> in_order(const LinkLayer& link, std::span<Reception> receptions) {
    std::vector<Reception*> ordered;
    for (Reception& each : receptions) ordered.push_back(&each);
    std::sort(ordered.begin(), ordered.end(), [&](const Reception* a, const Reception* b) {
        return a->time != b->time ? a->time < b->time : link.key(a->node) < link.key(b->node);
    });
    return ordered;
}

}  // namespace rovernet
