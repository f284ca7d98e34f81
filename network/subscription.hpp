// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>
#include <utility>

// Callbacks of a Network: handles that end callbacks, and data passed to callbacks for messages.

namespace rovernet {

/// Handle that can end a callback of a Network. A Subscription may outlive the Network. Destroying
/// a Subscription does not end its callback, so a returned Subscription may be ignored.
///
///   Subscription heard = network.on_receive(node, [&](const Message&) { heard.end(); });
class Subscription {
  public:
    /// Subscription without a callback.
    Subscription() = default;
    /// @param ended  flag of a callback, not null
    explicit Subscription(std::shared_ptr<bool> ended) : ended_(std::move(ended)) {}

    /// Ends the callback: the callback is not called again, even if its event is queued. A second
    /// call of end() does nothing.
    void end() {
        if (ended_) *ended_ = true;
        ended_.reset();
    }

  private:
    // End flag in the callback's state; the pointer keeps the state alive. Null after end().
    std::shared_ptr<bool> ended_;
};

/// Message that a node receives, with data of the received frame. The reference is valid during the
/// callback.
struct Heard {
    const Message& message;
    /// Number of hops that the message travelled.
    int hops;
    /// Transmitter of the frame.
    NodeId last_hop;
    /// Received power of the frame [dBm]; empty unless HearOptions::level is true for the callback.
    std::optional<Dbm> level = {};
};

/// Options of a callback for received messages.
struct HearOptions {
    /// True: Heard::level is computed, at the start of each frame that this node can decode.
    bool level = false;
};

}  // namespace rovernet
