// SPDX-License-Identifier: MIT
#include "models/medium/neighbour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rovernet {

int link_quality(Db margin) {
    return static_cast<int>(std::clamp(std::floor(2 * margin.value + 0.5), 0.0, 100.0));
}

std::vector<Neighbour> neighbours(const Medium& medium, const Legs& legs, NodeId node, Time t) {
    std::vector<Neighbour> heard;
    const Radio& here = medium.radio(node);
    for (std::uint32_t i = 0; i < legs.size(); ++i) {
        const NodeId from{i};
        if (!medium.link_up(from, node, t, legs)) continue;
        const Db loss = medium.path_loss(from, node, t, legs);
        const Radio& there = medium.radio(from);
        heard.push_back({.node = from,
                         .level = received_power(there, here, loss),
                         .noise = noise_floor(here),
                         .quality = link_quality(link_budget(there, here) - loss)});
    }
    return heard;
}

}  // namespace rovernet
