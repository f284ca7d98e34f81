// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/reception/judge.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <memory>
#include <string_view>

// Reception with overlap, capture and half-duplex, but without powers added up. In code:
//
//     Network network({.reception = Collision{.capture_ratio = Db{6}}});

namespace rovernet {

/// Order in which two frames that overlap may begin for one to survive (capture).
enum class CaptureOrder {
    /// Only the frame that the receiver is at survives, as in ns-2.
    first,
    /// Either may survive.
    later,
};
/// Words of [reception] capture.
template <>
struct EnumNames<CaptureOrder> {
    static constexpr std::array<std::string_view, 2> values = {"first", "later"};
};

/// Reception model "collision": frames that overlap at a node destroy each other, unless one
/// captures it; and a node that sends hears nothing (half-duplex).
///
///   first    |========|          stronger by the ratio: first survives, second is let pass
///   second        |========|     otherwise: both are lost with CaptureOrder::first; with `later`
///                                second survives if it is stronger by the ratio
///
/// CaptureOrder::first: a receiver that is free is at the first frame that it senses, until that is
/// over. A frame that begins in the meantime and is weaker by the capture ratio is let pass: it is
/// lost, and harms nobody, be it on air for longer than the first. Any other destroys the one that
/// the receiver is at and is lost itself, and the receiver is free again when both are over. Of two
/// that begin together the receiver is at the stronger one. Whether a frame was let pass is decided
/// by who was on air when it began, without asking whether those had been let pass themselves.
///
/// CaptureOrder::later: of two that overlap, the one that is stronger by the capture ratio
/// survives.
///
/// Source: what ns-2.35's 802.11 does, whose receiver compares a frame with the one that it is at.
struct Collision {
    static constexpr std::string_view name = "collision";

    /// Capture ratio [dB], > 0: how much stronger a frame is that survives another.
    Db capture_ratio{10};
    /// Order in which the survivor and the other may begin.
    CaptureOrder capture = CaptureOrder::first;

    /// Whether `frame` survives `other` at the same node, if that one was not let pass.
    /// @param is_stronger  is_stronger(frame, other, capture_ratio), asked only where it matters:
    /// levels cost a path loss
    template <class IsStronger>
    bool survives(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        if (!frame.overlaps(other)) return true;
        if (other.own || finds_receiver_at(frame, other)) return false;
        return is_stronger(frame, other, capture_ratio);
    }
    /// Whether the receiver was at `other`, if that was not let pass, when `frame` began.
    bool finds_receiver_at(const Arrival& frame, const Arrival& other) const {
        return capture == CaptureOrder::first && frame.begin > other.begin;
    }
    /// Whether the receiver lets `frame` pass, as it is at `other`.
    template <class IsStronger>
    bool lets_pass(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        const bool is_at = other.begin <= frame.begin && frame.begin < other.end && !other.own;
        return is_at && is_stronger(other, frame, capture_ratio);
    }

    /// Judge for one Network.
    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
