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
    return (decoded & bit(fate)) != 0;
}
/// Why a frame was lost at a receiver, as in an ns-2 trace; nothing for a decoded one.
constexpr std::string_view reason_of_loss(Fate fate) {
    switch (fate) {
        case Fate::off: return "SLP";
        case Fate::garbled: return "ERR";
        case Fate::collided: return "COL";
        case Fate::busy: return "BSY";
        default: return {};
    }
}

/// Why a copy was lost other than by the fate of its reception.
enum class DropReason : std::uint8_t {
    off,         ///< its holder was switched off while the copy waited to be forwarded
    queue_full,  ///< its sender's queue had no room for it
    retries,     ///< a unicast: no answer came, however often it was sent
    end,         ///< still queued when its sender was switched off
};

/// The reason as in an ns-2 trace.
constexpr std::string_view reason_of(DropReason reason) {
    switch (reason) {
        case DropReason::off: return "SLP";
        case DropReason::queue_full: return "IFQ";
        case DropReason::retries: return "RET";
        case DropReason::end: return "END";
    }
    return {};
}

}  // namespace rovernet
