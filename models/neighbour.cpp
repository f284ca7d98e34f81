// SPDX-License-Identifier: MIT
#include "models/neighbour.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rovernet {

Dbm noise_floor(const Radio& radio) {
    constexpr double thermal = -173.97518719422808;  // 10 log10(k 290 K / 1 mW), per hertz
    return Dbm{thermal + 10 * math::log10(radio.bandwidth.value)} + radio.noise_figure;
}

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
