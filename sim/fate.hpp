// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace rovernet {

/// What became of a decoded copy at its receiver. The router says; the record tells.
enum class Fate : std::uint8_t {
    waiting,    ///< will be forwarded after its delay
    ttl,        ///< crossed its last hop: not forwarded
    duplicate,  ///< suppressed: the receiver had a copy already
    off,        ///< the receiver was switched off between the start and the end of the frame
    garbled,    ///< reached the receiver with errors
    collided,   ///< another frame was on air at the receiver
    busy,       ///< the receiver was sending
    arrived,    ///< at the robot that it was meant for
};

/// The receiver has the frame, whatever it does with it.
constexpr bool is_decoded(Fate fate) {
    constexpr auto bit = [](Fate f) { return 1U << static_cast<unsigned>(f); };
    constexpr unsigned decoded =
        bit(Fate::waiting) | bit(Fate::ttl) | bit(Fate::duplicate) | bit(Fate::arrived);
    return (decoded >> static_cast<unsigned>(fate) & 1) != 0;
}
/// Why a copy was lost other than by the fate of its reception.
enum class DropReason : std::uint8_t {
    off,         ///< its holder was switched off while the copy waited to be forwarded
    queue_full,  ///< its sender's queue had no room for it
    retries,     ///< a unicast: no answer came, however often it was sent
    end,         ///< still queued when its sender was switched off
    unheard,     ///< a unicast without acknowledgements: who it was for cannot hear its sender
    cut_off,     ///< the run ended before any frame of the message did
};

/// A reason for which a copy goes no further.
struct LossReason {
    std::string_view code;   ///< as in an ns-2 trace and in the metric drops.CODE; empty: none
    std::string_view layer;  ///< of ns-2, that tells of it
    friend bool operator==(const LossReason&, const LossReason&) = default;
};

// The table of all reasons. It has no default: an enumerator without a line does not compile.

/// Why a copy that was received, or lost there, went no further; nothing for one that does.
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

// The last enumerators; one that is added behind them is noticed below.
inline constexpr auto last_fate = Fate::arrived;
inline constexpr auto last_drop_reason = DropReason::cut_off;
static_assert(reason_of(static_cast<Fate>(static_cast<int>(last_fate) + 1)) == LossReason{} &&
              reason_of(static_cast<DropReason>(static_cast<int>(last_drop_reason) + 1)) ==
                  LossReason{});

/// Calls visit(enumerator) for every fate, then for every other reason of a drop.
template <class Visit>
constexpr void for_each_reason(Visit visit) {
    for (int i = 0; i <= static_cast<int>(last_fate); ++i) visit(static_cast<Fate>(i));
    for (int i = 0; i <= static_cast<int>(last_drop_reason); ++i) visit(static_cast<DropReason>(i));
}

}  // namespace rovernet
