// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/reception/judge.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <memory>
#include <string_view>

// Reception with collisions, capture and half-duplex, without a sum of interfering powers. In code:
//
//     Network network({.reception = Collision{.capture_ratio = Db{6}}});

namespace rovernet {

/// Order in which two overlapping frames may begin for one to survive (capture).
enum class CaptureOrder {
    /// Only the frame that the receiver is receiving can survive, as in ns-2.
    first,
    /// Either frame can survive.
    later,
};
/// Names of the values of [reception] capture in scenario files.
template <>
struct EnumNames<CaptureOrder> {
    static constexpr std::array<std::string_view, 2> values = {"first", "later"};
};

/// Reception model "collision": frames that overlap at a node destroy each other, unless one
/// captures the receiver; a transmitting node receives nothing (half-duplex).
///
///   first    |========|          stronger by the ratio: first survives, second is ignored
///   second        |========|     otherwise: both are lost with CaptureOrder::first; with `later`
///                                second survives if it is stronger by the ratio
///
/// CaptureOrder::first: a free receiver receives the first frame that it senses, until that ends. A
/// later frame that is weaker by the capture ratio is ignored: it is lost and has no effect, even
/// if it lasts longer than the first. Any other later frame destroys the received frame and is lost
/// itself; the receiver is free again when both have ended. Of two frames that begin together the
/// stronger one is received. Whether a frame is ignored depends on the frames on air at its
/// beginning, even if these were ignored themselves.
///
/// CaptureOrder::later: of two overlapping frames, a frame that is stronger by the capture ratio
/// survives.
///
/// Source: the 802.11 model of ns-2.35, whose receiver compares a new frame with the one being
/// received.
struct Collision {
    static constexpr std::string_view name = "collision";

    /// Capture ratio [dB], > 0: level difference by which a frame must exceed another to survive.
    Db capture_ratio{10};
    /// Order in which two overlapping frames must begin for the stronger one to survive.
    CaptureOrder capture = CaptureOrder::first;

    static constexpr auto fields() {
        return describe(field("capture_ratio", &Collision::capture_ratio, positive,
                              "how much stronger a frame is that survives another"),
                        field("capture", &Collision::capture,
                              "which of two frames may survive: the first, or also the later one"));
    }

    /// Whether `frame` survives `other` at the same node, if `other` was not ignored.
    /// @param is_stronger  is_stronger(frame, other, capture_ratio), called only if needed, because
    ///                     a level requires the computation of a path loss
    template <class IsStronger>
    bool survives(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        if (!frame.overlaps(other)) return true;
        if (other.own || finds_receiver_at(frame, other)) return false;
        return is_stronger(frame, other, capture_ratio);
    }
    /// Whether the receiver was receiving `other`, if that was not ignored, when `frame` began.
    bool finds_receiver_at(const Arrival& frame, const Arrival& other) const {
        return capture == CaptureOrder::first && frame.begin > other.begin;
    }
    /// Whether the receiver ignores `frame`, because it is receiving `other`.
    template <class IsStronger>
    bool lets_pass(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        const bool is_at = other.begin <= frame.begin && frame.begin < other.end && !other.own;
        return is_at && is_stronger(other, frame, capture_ratio);
    }

    /// Creates the judge for one Network.
    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
