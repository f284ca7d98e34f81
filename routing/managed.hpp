// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <string_view>

namespace rovernet {

/// Managed flood of Meshtastic, for messages to everyone: each relay waits for a random number of
/// slots, the fewer the weaker it received the message, and holds back if another one relays the
/// message first.
///
/// Roles (Robot::role): "client", or none; "router" relays early and does not hold back;
/// "router_late" relays after all others in place of holding back; "mute" never relays. Messages to
/// one robot go over one hop, and a node sends its own messages at once. docs/routing.md has the
/// rules M1 to M6, and what is left out.
struct Managed {
    static constexpr std::string_view name = "managed";
    /// Roles of nodes.
    static constexpr std::array<std::string_view, 4> roles{"client", "router", "router_late",
                                                           "mute"};

    /// Number of times that a message may be relayed, 1 ... 7. Frame::ttl of a copy is its hop
    /// limit + 1.
    int hop_limit = 3;
    /// Duration of a slot [ns]: that of 802.11. LoRa has longer ones: 28 ms for LONG_FAST.
    Duration slot = std::chrono::microseconds{20};

    static constexpr auto fields() {
        return describe(
            field("hop_limit", &Managed::hop_limit,
                  Range{.low = 1, .high = 7, .text = "from 1 to 7"},
                  "number of times that a message may be relayed"),
            field("slot", &Managed::slot, Range{.low = 0, .high = 1e3, .text = "from 0 to 1000 s"},
                  "unit of a relay's random delay"));
    }

    operator Router() const;
};

}  // namespace rovernet
