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

/// Capture rule: determines which of two overlapping frames can survive, by the order of their
/// beginnings.
enum class CaptureOrder {
    /// Only the first frame, which the receiver is already receiving, can survive, as in ns-2.
    first,
    /// The first frame or the frame that begins later can survive, whichever is stronger.
    later,
};
/// Names of the values of [reception] capture in scenario files.
template <>
struct EnumNames<CaptureOrder> {
    static constexpr std::array<std::string_view, 2> values = {"first", "later"};
};

/// Reception model "collision": frames that overlap at a node collide. Both frames are lost, unless
/// one of them captures the receiver. A transmitting node receives nothing (half-duplex).
///
///   first    |========|          stronger by the ratio: first survives, second is ignored
///   second        |========|     otherwise: both are lost with CaptureOrder::first; with `later`
///                                second survives if it is stronger by the ratio
///
/// CaptureOrder::first: a free receiver receives the first frame that it senses, until that frame
/// ends. A later frame that is weaker by the capture ratio is ignored: it is lost and has no
/// effect, even if it lasts longer than the first. Any other later frame collides with the received
/// frame: both are lost, and the receiver is free again when both have ended. Until then, the
/// receiver compares new frames with the one that ends last. Of two frames that begin together the
/// stronger one is received. An ignored frame is compared with no other frame. See
/// CollisionReceiver.
///
/// CaptureOrder::later: of two overlapping frames, a frame that is stronger by the capture ratio
/// survives.
///
/// Source: the 802.11 model of ns-2.35, whose receiver compares a new frame with the one being
/// received.
struct Collision {
    static constexpr std::string_view name = "collision";

    /// Capture ratio [dB], > 0: smallest level difference at which the stronger of two overlapping
    /// frames survives.
    Db capture_ratio{10};
    /// Capture rule: whether only the first of two overlapping frames can survive, or either.
    CaptureOrder capture = CaptureOrder::first;

    static constexpr auto fields() {
        return describe(field("capture_ratio", &Collision::capture_ratio, positive,
                              "a frame survives a collision (is received) if its level is higher "
                              "than the level of the other frame by this ratio"),
                        field("capture", &Collision::capture,
                              "which of two frames may survive a collision. first: only the frame "
                              "that began first; later: either frame"));
    }

    /// Whether `frame` survives the overlap with `other` at a node. The result is valid if the
    /// receiver did not ignore `other`.
    /// @param is_stronger  is_stronger(frame, other, capture_ratio), called only if needed, because
    ///                     a level requires the computation of a path loss
    template <class IsStronger>
    bool survives(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        if (!frame.overlaps(other)) return true;
        if (other.own || finds_receiver_at(frame, other)) return false;
        return is_stronger(frame, other, capture_ratio);
    }
    /// Whether the receiver was receiving `other` when `frame` began. The result is valid if the
    /// receiver did not ignore `other`.
    bool finds_receiver_at(const Arrival& frame, const Arrival& other) const {
        return capture == CaptureOrder::first && frame.begin > other.begin;
    }
    /// Whether the receiver ignores `frame`, because the receiver is receiving the stronger frame
    /// `other`. The result is valid if the receiver did not ignore `other`.
    template <class IsStronger>
    bool lets_pass(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        const bool is_at = other.begin <= frame.begin && frame.begin < other.end && !other.own;
        return is_at && is_stronger(other, frame, capture_ratio);
    }

    /// Creates the judge for one Network.
    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
