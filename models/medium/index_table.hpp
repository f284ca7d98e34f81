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

/// Node and where it is: what a query of a NeighbourIndex looks at.
struct IndexEntry {
    /// Position [m] where its leg begins; where it is if it does not move.
    Vec3 from;
    NodeId node;
    /// Label that NeighbourIndex::add() was given.
    std::uint32_t label : 31;
    /// It moves at some time of its leg.
    std::uint32_t moves : 1;
};

/// Table of nodes in a NeighbourIndex: their entries, and apart from these what only nodes that
/// move need.
struct IndexTable {
    struct Motion {
        Vec3 velocity;
        Time start, end;
    };
    std::vector<IndexEntry> entries;
    /// Motions of the entries; none as long as nobody moves.
    std::vector<Motion> motions;

    /// Writes entry `i`, from a leg or from another table.
    void put(std::size_t i, NodeId node, std::uint32_t label, const Leg& leg);
    void put(std::size_t i, const IndexEntry& entry, const Motion& motion);
    /// Motion of entry `i`.
    Motion motion(std::size_t i) const { return entries[i].moves ? motions[i] : Motion{}; }
    /// Position of entry `i` [m]: as `legs` have it, without looking there while its leg lasts.
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
