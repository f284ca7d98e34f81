// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <limits>
#include <optional>

// Frames between sender and receiver, for reception models: a Transmission has the rate, coding and
// durations of a frame, an Emission is the frame on air, an Arrival is the frame at one node.

namespace rovernet {

/// Modulation and coding scheme, as a number that the physical layer defines.
enum class Coding : std::uint8_t {};

/// Transmission parameters of a frame. The physical layer computes them for each frame; the medium,
/// the reception model and records use them.
struct Transmission {
    /// Bit rate of the payload [bit/s].
    BitRate rate;
    /// Modulation and coding of the payload; 0 if the physical layer does not know the bit rate.
    Coding coding{};
    /// Bandwidth of the signal [Hz].
    Hertz bandwidth;
    /// Duration of the preamble [ns], and of the payload after it.
    Duration preamble, payload;
    /// Size of the frame [bytes], including the bytes that the access model adds.
    std::uint32_t bytes;

    /// Time on air of the whole frame [ns]: preamble and payload.
    Duration airtime() const { return preamble + payload; }
};

/// Rule of a physical layer for the detection of a preamble.
struct PreambleDetection {
    /// Time [ns] after the start of the preamble at which its SINR is compared with the threshold.
    Duration after{4'000};
    /// Smallest SINR [dB] at which a preamble is detected; empty: threshold of the reception model.
    std::optional<Db> threshold = std::nullopt;
};

/// Frame as transmitted. Interference stores the Emission while the frame may overlap with other
/// frames. The judge of the reception model stores its own data of the frame at the index `flight`.
struct Emission {
    /// Begin and end of the frame at its sender.
    Time begin, end;
    /// Position of the sender's antenna at `begin` [m].
    Vec3 origin = {};
    /// Node that transmits the frame.
    NodeId from;
    /// Distance [m] from the sender's antenna to the farthest receiver of the frame.
    double heard_within = 0;
    /// Square of the largest distance [m^2] at which the frame interferes; may be infinite.
    double squared_reach = 0;
    /// Index of the frame in the Channel's list of frames on air.
    std::uint32_t flight = 0;
    /// Modulation and coding of the frame.
    Coding coding{};
    /// Serial number of the frame, in the order of transmission.
    std::uint64_t serial = 0;
};

/// State of a receiver of the model "sinr" for a frame that it could decode.
enum class Lock : std::uint8_t {
    /// Undecided: whether the receiver locks onto the frame is not computed yet.
    open,
    /// The receiver locked onto the frame: it was free and detected the preamble.
    held,
    /// The receiver did not lock onto the frame.
    missed,
};

/// Frame at a node that senses it, for access models. When a frame starts, Channel makes a Sensing
/// for each node that senses the frame.
struct Sensing {
    NodeId node;
    /// True if the signal is strong enough to be decoded. The access model is then also notified at
    /// the end of the frame whether the node received the frame.
    bool decodable;
    /// Modulation and coding of the frame.
    Coding coding{};
    /// Begin and end of the frame at the node.
    Time begin, end;
};

/// Frame as it arrives at one node: the input of a reception model's judge. The times include the
/// propagation delay to the node.
struct Arrival {
    /// Begin and end of the frame at this node.
    Time begin;
    Time end;
    /// Received power [dBm]; NaN until the power is computed.
    double level_dbm;
    /// Squared distance [m^2] from the sender's antenna to the node's antenna when the frame began;
    /// NaN if not computed.
    double squared_distance;
    /// Node that transmits the frame.
    NodeId from;
    /// True if the node of this Arrival is itself the sender of the frame. The node cannot receive
    /// other frames during its own frame.
    bool own = false;
    /// Modulation and coding of the frame.
    Coding coding{};
    /// Lock state of the receiver for this frame, for the model "sinr"; null if the node cannot
    /// decode the frame.
    Lock* lock = nullptr;

    /// Whether this frame and `other` overlap in time at the node; adjacent frames do not overlap.
    bool overlaps(const Arrival& other) const { return begin < other.end && other.begin < end; }
};

/// Arrival of a node's own frame at the node itself: infinitely strong, because a node receives no
/// other frame during its own frame.
constexpr Arrival own_frame(NodeId node, Time begin, Time end) {
    return {.begin = begin,
            .end = end,
            .level_dbm = std::numeric_limits<double>::infinity(),
            .squared_distance = 0,
            .from = node,
            .own = true};
}

}  // namespace rovernet
