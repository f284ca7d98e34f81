// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>
#include <utility>

// Callbacks of a Network: handles that end them, and what those for messages get.

namespace rovernet {

/// Handle that can end a callback of a Network. It may outlive the network. Destroying it does not
/// end the callback, so it may be ignored.
///
///   Subscription heard = network.on_receive(node, [&](const Message&) { heard.end(); });
class Subscription {
  public:
    /// Subscription without a callback.
    Subscription() = default;
    /// @param ended  flag of a callback, not null
    explicit Subscription(std::shared_ptr<bool> ended) : ended_(std::move(ended)) {}

    /// Ends the callback: it is not called again, not even if it is due. A second call does
    /// nothing.
    void end() {
        if (ended_) *ended_ = true;
        ended_.reset();
    }

  private:
    // Flag in the callback's state, which it keeps alive; null after end().
    std::shared_ptr<bool> ended_;
};

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
