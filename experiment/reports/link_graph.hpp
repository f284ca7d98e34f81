// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rovernet {

/// Topology of a network: the graph of bidirectional links.
struct LinkGraph {
    std::vector<std::size_t> parts;  ///< number of each robot's connected component, from 0
    /// Articulation points: robots without which a connected component would split, in ascending
    /// order.
    std::vector<std::size_t> cut;
    int diameter = 0;  ///< longest shortest path between connected robots [hops]
};

/// Computes the topology of a network of `robots` robots.
/// @param links  pairs of robots with a bidirectional link, each once
LinkGraph link_graph(std::size_t robots,
                     const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links);

}  // namespace rovernet
