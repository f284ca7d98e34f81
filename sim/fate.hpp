// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

// Why a packet goes no further. One table gives each reason its code and its layer; metrics, ns-2
// traces and studies know a new reason from that table alone.

namespace rovernet {

/// Fate of a copy of a frame at one receiver, at which it was strong enough to be decoded.
///
/// The reception model sets `garbled`, `collided` and `busy`; the sender's success rate `garbled`,
/// too. The network sets `off`; `duplicate` for a frame that its sender repeated, and `arrived` for
/// a packet that no protocol routes. All else is the routing protocol's to say, in its on_receive.
/// Received carries it to the sinks.
enum class Fate : std::uint8_t {
    /// Received; it will be forwarded after its delay.
    waiting,
    /// Received, and not forwarded: it crossed its last hop.
    ttl,
    /// Received, and suppressed: the receiver had a copy already.
    duplicate,
    /// Lost: the receiver was switched off between the start and the end of the frame.
    off,
    /// Lost: it reached the receiver with errors.
    garbled,
    /// Lost: another frame was on air at the receiver.
    collided,
    /// Lost: the receiver was sending itself (half-duplex).
    busy,
    /// Received by the robot that it was meant for.
    arrived,
};

/// Whether the receiver has the frame, whatever it does with it. Without a branch: it is asked for
/// each reception.
constexpr bool is_decoded(Fate fate) {
    constexpr auto bit = [](Fate f) { return 1U << static_cast<unsigned>(f); };
    constexpr unsigned decoded =
        bit(Fate::waiting) | bit(Fate::ttl) | bit(Fate::duplicate) | bit(Fate::arrived);
    return (decoded >> static_cast<unsigned>(fate) & 1) != 0;
}

/// Reason for which a copy is lost other than by the fate of a reception. Dropped carries it to the
/// sinks.
///
/// The access model says `queue_full`, `retries` and `end`, the network `off`, `unheard` and
/// `cut_off`. A routing protocol says by LinkLayer::drop what it gives up itself.
enum class DropReason : std::uint8_t {
    /// The node was switched off while the copy waited to be forwarded.
    off,
    /// The node's interface queue had no room for it.
    queue_full,
    /// A unicast: no acknowledgement came, however often it was sent.
    retries,
    /// The node was switched off while the copy was in its interface queue.
    end,
    /// A unicast at an access model without acknowledgements: its destination cannot hear its
    /// sender.
    unheard,
    /// The run ended before any frame of the message did.
    cut_off,
};

/// Reason for which a copy goes no further, as it is written.
struct LossReason {
    /// Code of three or four letters, as in an ns-2 trace and in the metric drops.CODE; empty: the
    /// copy is not lost.
    std::string_view code;
    /// Layer of ns-2 whose line tells of it: AGT (application), RTR (routing), IFQ (interface
    /// queue), MAC.
    std::string_view layer;
    friend bool operator==(const LossReason&, const LossReason&) = default;
};

// The table of all reasons. It has no default: an enumerator without a line does not compile.

/// Reason for which a copy that was received, or lost there, goes no further; none for one that
/// does.
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
/// Reason for which a copy that waited goes no further. Several may share a code: they differ in
/// their layer.
constexpr LossReason reason_of(DropReason reason) {
    switch (reason) {
        case DropReason::off: return {"SLP", "RTR"};
        case DropReason::queue_full: return {"IFQ", "IFQ"};
        case DropReason::retries: return {"RET", "MAC"};
        case DropReason::end: return {"END", "IFQ"};
        case DropReason::unheard: return {"NRTE", "MAC"};
        case DropReason::cut_off: return {"END", "AGT"};
    }
    return {};
}

// The last enumerators. One that is added behind them is noticed below: its reason is not empty.
inline constexpr auto last_fate = Fate::arrived;
inline constexpr auto last_drop_reason = DropReason::cut_off;
static_assert(reason_of(static_cast<Fate>(static_cast<int>(last_fate) + 1)) == LossReason{} &&
              reason_of(static_cast<DropReason>(static_cast<int>(last_drop_reason) + 1)) ==
                  LossReason{});

/// Calls visit(enumerator) for every fate, then for every other reason of a drop: what counts
/// losses or reads their codes needs no list of its own.
template <class Visit>
constexpr void for_each_reason(Visit visit) {
    for (int i = 0; i <= static_cast<int>(last_fate); ++i) visit(static_cast<Fate>(i));
    for (int i = 0; i <= static_cast<int>(last_drop_reason); ++i) visit(static_cast<DropReason>(i));
}

}  // namespace rovernet
