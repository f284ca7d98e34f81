// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

// Handles that end callbacks, returned by Network::on_receive and similar functions.

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

}  // namespace rovernet
