// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <limits>

namespace rovernet {

/// A frame as it was sent.
struct Emission {
    Time begin, end;           ///< at the sender
    Vec3 origin = {};          ///< [m] the sender's antenna at `begin`
    NodeId from;               ///< its sender
    double heard_within = 0;   ///< [m] from the origin: nobody farther is a receiver
    double squared_reach = 0;  ///< [m^2] nobody farther is disturbed; may be infinite
    std::uint32_t flight = 0;  ///< known to the caller
    std::uint64_t serial = 0;  ///< its number, in the order of sending
};

/// What a receiver of the model "sinr" made of a frame that it could decode.
enum class Lock : std::uint8_t {
    open,    ///< not decided yet
    held,    ///< it locked on to it
    missed,  ///< it did not
};

/// A frame as a node will sense it.
struct Sensing {
    NodeId node;
    Time begin, end;
};

/// A frame as it arrives at one node.
struct Arrival {
    Time begin;
    Time end;
    double level_dbm;         ///< [dBm] received power; NaN until somebody asked for it
    double squared_distance;  ///< [m^2] from where it was sent
    NodeId from;              ///< its sender
    bool own = false;         ///< the node sends it itself, and hears nothing else
    Lock* lock = nullptr;     ///< reception model "sinr": if the node can decode it

    bool overlaps(const Arrival& other) const { return begin < other.end && other.begin < end; }
};

/// What a node sends, as it drowns everything there.
constexpr Arrival own_frame(NodeId node, Time begin, Time end) {
    return {.begin = begin,
            .end = end,
            .level_dbm = std::numeric_limits<double>::infinity(),
            .squared_distance = 0,
            .from = node,
            .own = true};
}

}  // namespace rovernet
