// SPDX-License-Identifier: MIT
#pragma once

#include "sim/link_layer.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace rovernet {

/// Receptions in the order in which a protocol serves them: by time, and nodes that receive at the
/// same time by their keys, so that their ids have no effect.
inline std::vector<Reception*> in_order(const LinkLayer& link, std::span<Reception> receptions) {
    std::vector<Reception*> ordered;
    for (Reception& each : receptions) ordered.push_back(&each);
    std::sort(ordered.begin(), ordered.end(), [&](const Reception* a, const Reception* b) {
        return a->time != b->time ? a->time < b->time : link.key(a->node) < link.key(b->node);
    });
    return ordered;
}

}  // namespace rovernet
