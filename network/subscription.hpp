// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

namespace rovernet {

/// The right to end a callback of a Network. Letting it go ends nothing.
class Subscription {
  public:
    Subscription() = default;
    explicit Subscription(std::shared_ptr<bool> ended) : ended_(std::move(ended)) {}

    /// The callback is called no more, not even if it is due.
    void end() {
        if (ended_) *ended_ = true;
        ended_.reset();
    }

  private:
    std::shared_ptr<bool> ended_;
};

}  // namespace rovernet
