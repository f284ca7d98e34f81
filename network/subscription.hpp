// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

// Ends of callbacks. Network::on_receive and its kind return one each.

namespace rovernet {

/// Right to end a callback of a Network. It may outlive the network, and letting it go ends
/// nothing: who never wants to end a callback need not keep it.
///
///   Subscription heard = network.on_receive(node, [&](const Message&) { heard.end(); });
class Subscription {
  public:
    /// Subscription to nothing.
    Subscription() = default;
    /// @param ended  flag of a callback, not null
    explicit Subscription(std::shared_ptr<bool> ended) : ended_(std::move(ended)) {}

    /// Ends the callback: it is called no more, not even if it is due. A second call does nothing.
    void end() {
        if (ended_) *ended_ = true;
        ended_.reset();
    }

  private:
    // Flag of the callback's state, which it keeps alive; null once it was ended.
    std::shared_ptr<bool> ended_;
};

}  // namespace rovernet
