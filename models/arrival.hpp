// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <limits>

// Frames between sender and receiver, for reception models: an Emission is what was sent, an
// Arrival what comes of it at one node.

namespace rovernet {

/// Frame as it was sent. Interference keeps it for as long as it may overlap with others; a judge
/// finds what it keeps beside it by `flight`.
struct Emission {
    /// Begin and end at the sender.
    Time begin, end;
    /// Position of the sender's antenna at `begin` [m].
    Vec3 origin = {};
    /// Sender.
    NodeId from;
    /// Distance from the origin [m] within which all its receivers are.
    double heard_within = 0;
    /// Squared distance [m^2] beyond which it interferes with nobody; may be infinite.
    double squared_reach = 0;
    /// Number that the channel knows the frame by.
    std::uint32_t flight = 0;
    /// Number in the order of sending.
    std::uint64_t serial = 0;
};

/// State of a receiver of the model "sinr" towards a frame that it could decode.
enum class Lock : std::uint8_t {
    /// It is not decided yet.
    open,
    /// The receiver locked on to it: it found the preamble, and was free.
    held,
    /// The receiver did not.
    missed,
};

/// Frame as a node will sense it, for access models: Channel makes one for each node that senses a
/// frame as it goes on air.
struct Sensing {
    NodeId node;
    /// It is strong enough to be decoded. The access model is told what became of it.
    bool decodable;
    /// Begin and end at the node.
    Time begin, end;
};

/// Frame as it arrives at one node: the view of a judge. Times are those at the node, propagation
/// delay included.
struct Arrival {
    /// Begin and end at the node.
    Time begin;
    Time end;
    /// Received power [dBm]; NaN until somebody asked for it.
    double level_dbm;
    /// Squared distance [m^2] from where it was sent; NaN if nobody asked for it.
    double squared_distance;
    /// Sender.
    NodeId from;
    /// The node sends it itself, and hears nothing else meanwhile.
    bool own = false;
    /// Lock of the model "sinr"; null if the node cannot decode the frame.
    Lock* lock = nullptr;

    /// Whether both are on air at a time here; frames that only touch do not overlap.
    bool overlaps(const Arrival& other) const { return begin < other.end && other.begin < end; }
};

/// Frame of a node's own, as it arrives there: stronger than all others. Nothing is received
/// meanwhile.
constexpr Arrival own_frame(NodeId node, Time begin, Time end) {
    return {.begin = begin,
            .end = end,
            .level_dbm = std::numeric_limits<double>::infinity(),
            .squared_distance = 0,
            .from = node,
            .own = true};
}

}  // namespace rovernet
