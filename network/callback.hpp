// SPDX-License-Identifier: MIT
#pragma once

#include "network/subscription.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace rovernet {

/// A function of the user's that the network calls until its Subscription is ended. Shared, so that
/// it keeps its state and outlives its being ended while it runs.
template <class... Arguments>
class Callback {
  public:
    Callback() = default;
    explicit Callback(std::function<void(Arguments...)> call)
        : state_(std::make_shared<State>(State{std::move(call)})) {}

    void operator()(Arguments... arguments) const {
        if (!has_ended()) state_->call(arguments...);
    }
    bool has_ended() const { return state_->ended; }
    Subscription subscription() const {
        return Subscription(std::shared_ptr<bool>(state_, &state_->ended));
    }

  private:
    struct State {
        std::function<void(Arguments...)> call;
        bool ended = false;
    };
    std::shared_ptr<State> state_;
};

}  // namespace rovernet
