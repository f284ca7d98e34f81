// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <string_view>

namespace rovernet {

/// Managed flood of Meshtastic, for messages to everyone. Each relay waits for a random number of
/// slots: the weaker the received message, the fewer slots. A relay does not forward the message if
/// it first hears another relay do so.
///
/// Roles (Robot::role): "client", the default; "router" relays early, even if another relay was
/// first; "router_late" relays after all other relays if another relay was first; "mute" never
/// relays. Messages to one robot go over one hop. A node sends its own messages immediately.
/// docs/methods/routing.md lists the rules M1 to M6, and the parts of Meshtastic that are left out.
struct Managed {
    static constexpr std::string_view name = "managed";
    /// Roles that a node may have, see Robot::role.
    static constexpr std::array<std::string_view, 4> roles{"client", "router", "router_late",
                                                           "mute"};

    /// Number of times that a message may be relayed, 1 ... 7. Frame::ttl of a copy is its hop
    /// limit + 1.
    int hop_limit = 3;
    /// Duration of a slot [ns]; default: 20 us, the slot of IEEE 802.11. LoRa has longer slots: 28
    /// ms for LONG_FAST.
    Duration slot = std::chrono::microseconds{20};

    static constexpr auto fields() {
        return describe(
            field("hop_limit", &Managed::hop_limit,
                  Range{.low = 1, .high = 7, .text = "from 1 to 7"},
                  "number of times that a message may be relayed"),
            field("slot", &Managed::slot, Range{.low = 0, .high = 1e3, .text = "from 0 to 1000 s"},
                  "duration of a slot, the unit of the random delay before a robot relays a "
                  "message"));
    }

    operator Router() const;
};

}  // namespace rovernet
