// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/random.hpp"
#include "test/routing/graph.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rovernet::test {

/// Nodes at random positions in a square, which hear each other up to a range.
struct UnitDisc {
    std::vector<Vec3> at;
    std::vector<Graph::Edge> edges;
    std::uint32_t source = 0;

    /// @param side   side of the square [m]; `range` is in [m], too
    UnitDisc(std::size_t nodes, double side, double range, std::uint64_t seed) {
        const auto draw = [&](std::uint64_t index) {
            return uniform({.seed = seed, .purpose = Purpose::placement, .index = index});
        };
        for (std::size_t i = 0; i < nodes; ++i)
            at.push_back({side * draw(2 * i), side * draw(2 * i + 1), 0});
        for (std::uint32_t i = 0; i < nodes; ++i) {
            for (std::uint32_t j = 0; j < i; ++j) {
                if (distance(at[i], at[j]) <= range) edges.emplace_back(i, j);
            }
        }
        source = static_cast<std::uint32_t>(draw(2 * nodes) * static_cast<double>(nodes));
    }
    /// Neighbours of each node.
    std::vector<std::vector<std::uint32_t>> neighbours() const {
        std::vector<std::vector<std::uint32_t>> of(at.size());
        for (const auto& [a, b] : edges) of[a].push_back(b), of[b].push_back(a);
        return of;
    }
    /// Number of nodes that a chain of edges connects to the source, without the source.
    std::size_t reachable() const {
        const auto of = neighbours();
        std::vector<bool> is_reached(at.size());
        std::vector<std::uint32_t> todo{source};
        is_reached[source] = true;
        for (std::size_t i = 0; i < todo.size(); ++i) {
            for (const std::uint32_t next : of[todo[i]]) {
                if (is_reached[next]) continue;
                is_reached[next] = true;
                todo.push_back(next);
            }
        }
        return todo.size() - 1;
    }
    std::size_t largest_degree() const {
        std::size_t most = 0;
        for (const auto& each : neighbours()) most = std::max(most, each.size());
        return most;
    }
};

}  // namespace rovernet::test
