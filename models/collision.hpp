// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Which frame can capture a receiver where two overlap.
enum class CaptureOrder {
    first,  ///< the one that began first, as in ns-2
    later,  ///< either
};
template <>
struct EnumNames<CaptureOrder> {
    static constexpr std::array<std::string_view, 2> values = {"first", "later"};
};

/// Reception rung "collision": frames that overlap at a node destroy each other, unless one
/// captures it; and a node that sends hears nothing.
///
/// Of two frames f and g that overlap at a node, f survives g iff it is stronger by the capture
/// ratio and begins no later than g (or `order` lets a later one capture). The rule holds for each
/// pair, so that what becomes of a frame does not depend on the order in which they are looked at.
/// Source: ns-2.35's 802.11, whose receiver compares a frame with the one that it is at, only.
struct Collision {
    Db capture_ratio{10};  ///< [dB] > 0
    CaptureOrder capture = CaptureOrder::first;

    /// Whether `frame` survives that `other` arrives at the same node. is_stronger(frame, other,
    /// capture_ratio) is asked where it matters.
    template <class IsStronger>
    bool survives(Arrival& frame, Arrival& other, IsStronger is_stronger) const {
        if (!frame.overlaps(other)) return true;
        if (other.own || (frame.begin > other.begin && capture == CaptureOrder::first))
            return false;
        return is_stronger(frame, other, capture_ratio);
    }
};

}  // namespace rovernet
