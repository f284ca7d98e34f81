// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "sim/fields.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

// Pure and slotted ALOHA: the simplest access model with a queue. In code:
//
//     Network network({.access = Aloha{.slot = 1ms}});

namespace rovernet {

/// Access model "aloha": a frame is transmitted immediately, or at the start of the next slot,
/// without carrier sensing. A frame only waits for earlier frames of the same node.
///
///   pure      |==1==|==2==|   |==3==|       a frame during another starts at its end
///   slotted   |==1==|   |==2==|   |==3==|   frames start at multiples of the slot
///
/// A unicast is sent once, without an acknowledgement. With many senders of total load G, in frames
/// per frame time, the fraction of frames received is e^-2G, slotted e^-G; bench/aloha.hpp measures
/// this fraction.
///
/// Source: N. Abramson, The ALOHA system, AFIPS 1970; L. Roberts, ALOHA packet system with and
/// without slots and capture, 1975.
struct Aloha {
    static constexpr std::string_view name = "aloha";

    /// Slot duration [ns]: frames start at multiples of the slot (slotted ALOHA). 0 or empty:
    /// frames start immediately (pure ALOHA).
    std::optional<Duration> slot = std::nullopt;
    /// Largest number of frames waiting at a node, including the frame to be sent next; further
    /// frames are dropped.
    int queue = 50;
    /// True if control packets of the routing protocol are sent before messages of applications.
    bool priority = false;

    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1000000, .text = "from 1 to 1000000"};
        return describe(
            field("slot", &Aloha::slot, non_negative,
                  "frames start only at multiples of this time"),
            field("queue", &Aloha::queue, counts, "largest number of frames that wait at a robot"),
            field("priority", &Aloha::priority,
                  "true: control packets of the routing protocol are sent before messages"));
    }

    /// Creates the access model for one Network.
    std::unique_ptr<Access> make_access() const;
};

}  // namespace rovernet
