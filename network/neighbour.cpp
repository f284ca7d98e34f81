// SPDX-License-Identifier: MIT
#include "network/neighbour.hpp"

#include "models/medium/medium.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rovernet {

int link_quality(Db margin) {
    return static_cast<int>(std::clamp(std::floor(2 * margin.value + 0.5), 0.0, 100.0));
}

std::vector<Neighbour> neighbours(const Medium& medium, const Legs& legs, NodeId node, Time t) {
    std::vector<Neighbour> heard;
    for (std::uint32_t i = 0; i < legs.size(); ++i) {
        const NodeId from{i};
        if (!medium.links().is_up(from, node, t, legs)) continue;
        heard.push_back({.node = from,
                         .level = medium.links().level(from, node, t, legs),
                         .noise = noise_floor(medium.stations().radio(node)),
                         .quality = link_quality(medium.links().margin(from, node, t, legs))});
    }
    return heard;
}

}  // namespace rovernet
