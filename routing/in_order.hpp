// SPDX-License-Identifier: MIT
#pragma once

#include "sim/link_layer.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace rovernet {

/// Calls serve(reception) in the order in which a routing protocol serves receptions: by time, then
/// by the keys of their nodes, so that the ids of nodes have no effect.
/// @param receptions  receptions in order of time
template <class Serve>
void in_order(const LinkLayer& link, std::span<Reception> receptions, Serve serve) {
    for (auto next = receptions.begin(); next != receptions.end();) {
        const auto first = next++;
        while (next != receptions.end() && next->time == first->time) ++next;
        if (next - first == 1) {
            serve(*first);
            continue;
        }
        std::vector<Reception*> tied;
        for (auto each = first; each != next; ++each) tied.push_back(&*each);
        std::sort(tied.begin(), tied.end(), [&](const Reception* a, const Reception* b) {
            return link.key(a->node) < link.key(b->node);
        });
        for (Reception* each : tied) serve(*each);
    }
}

}  // namespace rovernet
