// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rovernet {

/// Shape of a network: how links that work both ways join robots.
struct LinkGraph {
    std::vector<std::size_t> parts;  ///< part of each robot, from 0: robots of a part are joined
    std::vector<std::size_t> cut;    ///< robots without which a part would fall apart, in order
    int diameter = 0;  ///< longest of the shortest ways between robots that are joined [hops]
};

/// @param links  pairs of robots, each once
LinkGraph link_graph(std::size_t robots,
                     const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links);

}  // namespace rovernet
