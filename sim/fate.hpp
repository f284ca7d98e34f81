// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <string_view>

// Reasons for which a packet is lost or not forwarded. One table gives each reason its code and its
// layer; metrics, ns-2 traces and studies read a new reason from that table alone.

namespace rovernet {

/// Fate of a copy of a frame at one receiver at which the copy was strong enough to be decoded.
///
/// The reception model sets `garbled`, `collided` and `busy`; the sender's success rate also sets
/// `garbled`. The network sets `off`, `duplicate` for a frame that its sender repeated, and
/// `arrived` for a packet that is not routed. The routing protocol sets all other fates in
/// on_receive. Sinks read the fate in Received.
enum class Fate : std::uint8_t {
    /// Received: the node will forward the copy after a delay.
    waiting,
    /// Received, but not forwarded: the TTL of the copy is used up.
    ttl,
    /// Received, but suppressed: the receiver already had a copy.
    duplicate,
    /// Lost: the receiver was switched off between the start and the end of the frame.
    off,
    /// Lost: received with bit errors.
    garbled,
    /// Lost: the frame collided with another frame at the receiver.
    collided,
    /// Lost: the receiver was transmitting (half-duplex).
    busy,
    /// Received by its destination.
    arrived,
};

/// Whether a frame with this fate was decoded (forwarded or not). The function has
/// no branch, because it is called for every reception.
constexpr bool is_decoded(Fate fate) {
    constexpr auto bit = [](Fate f) { return 1U << static_cast<unsigned>(f); };
    constexpr unsigned decoded =
        bit(Fate::waiting) | bit(Fate::ttl) | bit(Fate::duplicate) | bit(Fate::arrived);
    return (decoded >> static_cast<unsigned>(fate) & 1) != 0;
}

/// Reception of one transmission at one receiver that could decode the frame without interference.
/// Medium::find_receivers sets node and time when the frame starts, whatever moves later; reception
/// model and routing protocol set the other fields when the frame ends.
struct Reception {
    /// Time at which the frame ends at this receiver.
    Time time;
    NodeId node;
    /// Fate of the copy at this receiver.
    Fate fate = Fate::waiting;
    /// True if the application gets the message: the copy is the first at this node, and the node
    /// is a destination.
    bool delivered = false;
    /// True if the receiver locked onto the frame. Only reception model "sinr" sets false, for lost
    /// frames.
    bool locked = true;

    /// Order in which the receptions of a transmission are served: by time, then by node.
    friend bool operator<(const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    }
};

/// Reason for the loss of a copy outside a reception. Sinks read the reason in Dropped.
///
/// The access model sets `queue_full`, `retries` and `end`; the network sets `off`, `unheard`,
/// `cut_off` and `held`. A routing protocol passes one of the reasons from `no_route` on, or a code
/// of its own, to LinkLayer::drop.
enum class DropReason : std::uint8_t {
    /// The node was switched off while the copy waited to be forwarded.
    off,
    /// The node's interface queue was full.
    queue_full,
    /// Unicast: no acknowledgement came within the retry limit.
    retries,
    /// The node was switched off while the copy was in its interface queue.
    end,
    /// Unicast without acknowledgements: the destination is out of the sender's range.
    unheard,
    /// The run ended before the first frame of the message ended.
    cut_off,
    /// The run ended while the message, which a routing protocol brings to one robot, was on its
    /// way: held by the protocol, queued or on air.
    held,
    /// The routing protocol knows no route to the destination.
    no_route,
    /// The packet came back to a node that had already sent it.
    loop,
    /// The route broke, and the protocol does not repair it.
    broken,
    /// The protocol's buffer of packets without a route was full.
    buffer_full,
    /// The packet waited too long for a route.
    timeout,
    /// The packet was sent on an alternative route (salvaged) too often.
    salvaged,
    /// Reason that a routing protocol defines itself, with the code Dropped::own_code.
    own,
    /// The address of the next hop was not resolved (ARP).
    unresolved,
};

/// Code and layer of a loss, as written in traces and metrics.
struct LossReason {
    /// Code of three or four letters, as in an ns-2 trace and in the metric drops.CODE; empty if
    /// the copy is not lost.
    std::string_view code;
    /// Layer in the ns-2 trace: AGT (application), RTR (routing), IFQ (interface queue), MAC.
    std::string_view layer;
    friend bool operator==(const LossReason&, const LossReason&) = default;
};

// Table of all reasons. The switch has no default: an enumerator without a line does not compile.

/// Code and layer of the loss of a copy with this fate; empty for a copy that is delivered or
/// forwarded.
constexpr LossReason reason_of(Fate fate) {
    switch (fate) {
        case Fate::waiting:
        case Fate::arrived: return {};
        case Fate::duplicate: return {"DUP", "RTR"};
        case Fate::ttl: return {"TTL", "RTR"};
        case Fate::off: return {"SLP", "MAC"};
        case Fate::garbled: return {"ERR", "MAC"};
        case Fate::collided: return {"COL", "MAC"};
        case Fate::busy: return {"BSY", "MAC"};
    }
    return {};
}
/// Code and layer of the loss of a copy outside a reception. Reasons with the same code differ in
/// their layer.
constexpr LossReason reason_of(DropReason reason) {
    switch (reason) {
        case DropReason::off: return {"SLP", "RTR"};
        case DropReason::queue_full: return {"IFQ", "IFQ"};
        case DropReason::retries: return {"RET", "MAC"};
        case DropReason::end: return {"END", "IFQ"};
        case DropReason::unheard: return {"OOR", "MAC"};
        case DropReason::cut_off: return {"END", "AGT"};
        case DropReason::held: return {"END", "RTR"};
        case DropReason::no_route: return {"NRTE", "RTR"};
        case DropReason::loop: return {"LOOP", "RTR"};
        case DropReason::broken: return {"CBK", "RTR"};
        case DropReason::buffer_full: return {"IFQ", "RTR"};
        case DropReason::timeout: return {"TOUT", "RTR"};
        case DropReason::salvaged: return {"SAL", "RTR"};
        case DropReason::own: return {"OWN", "RTR"};
        case DropReason::unresolved: return {"ARP", "IFQ"};
    }
    return {};
}

// Last enumerators of Fate and DropReason. Update these when an enumerator is appended; the
// static_assert below fails otherwise.
inline constexpr auto last_fate = Fate::arrived;
inline constexpr auto last_drop_reason = DropReason::unresolved;
static_assert(reason_of(static_cast<Fate>(static_cast<int>(last_fate) + 1)) == LossReason{} &&
              reason_of(static_cast<DropReason>(static_cast<int>(last_drop_reason) + 1)) ==
                  LossReason{});

/// Calls visit(enumerator) for every Fate, then for every DropReason, so that code that counts
/// losses needs no list of its own.
template <class Visit>
constexpr void for_each_reason(Visit visit) {
    for (int i = 0; i <= static_cast<int>(last_fate); ++i) visit(static_cast<Fate>(i));
    for (int i = 0; i <= static_cast<int>(last_drop_reason); ++i) visit(static_cast<DropReason>(i));
}

}  // namespace rovernet
