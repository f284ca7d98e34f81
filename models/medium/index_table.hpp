// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {

/// Entry of a NeighbourIndex: a node and its position, for queries.
struct IndexEntry {
    /// Position [m] of the node at the start of its leg; current position if the node does not
    /// move.
    Vec3 from;
    NodeId node;
    /// Number that the caller passed to NeighbourIndex::add() with the node.
    std::uint32_t label : 31;
    /// True if the node moves during its leg.
    std::uint32_t moves : 1;
};

/// Table of nodes in a NeighbourIndex: their entries, and a separate list of motions that only
/// moving nodes need.
struct IndexTable {
    struct Motion {
        Vec3 velocity;
        Time start, end;
    };
    std::vector<IndexEntry> entries;
    /// Velocity [m/s], start and end of the leg of each entry, by index; empty if no node moves.
    std::vector<Motion> motions;

    /// Writes entry `i` of this table, from a leg or from an entry of a second IndexTable.
    void put(std::size_t i, NodeId node, std::uint32_t label, const Leg& leg);
    void put(std::size_t i, const IndexEntry& entry, const Motion& motion);
    /// Velocity [m/s] and times of the leg of entry `i`; all zero if the node does not move.
    Motion motion(std::size_t i) const { return entries[i].moves ? motions[i] : Motion{}; }
    /// Position [m] at `t` of the node of entry `i`. Uses the copy of the leg in this table; reads
    /// `legs` only after the end of that leg.
    Vec3 position(std::size_t i, Time t, const Legs& legs) const {
        const IndexEntry& e = entries[i];
        if (!e.moves) return e.from;
        const Motion& motion = motions[i];
        if (t >= motion.end) [[unlikely]]
            return legs.leg(e.node).to;
        return e.from + seconds(t - motion.start) * motion.velocity;
    }
};

}  // namespace rovernet
