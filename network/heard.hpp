// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/units.hpp"

#include <optional>

namespace rovernet {

/// Message that a node receives, and the frame that brought it. References are valid during the
/// callback.
struct Heard {
    const Message& message;
    /// Number of hops that the message travelled.
    int hops;
    /// Transmitter of the frame.
    NodeId last_hop;
    /// Received power of the frame [dBm], if the callback asked for it.
    std::optional<Dbm> level = {};
};

/// Options of a callback for received messages.
struct HearOptions {
    /// True: Heard::level is computed, at the start of each frame that this node can decode.
    bool level = false;
};

}  // namespace rovernet
