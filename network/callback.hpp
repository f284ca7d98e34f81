// SPDX-License-Identifier: MIT
#pragma once

#include "network/subscription.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace rovernet {

/// User function that the network calls until its Subscription is ended.
///
/// Copies of a Callback share the function and its state. A callback may be ended while the
/// function runs, or while an event for the callback is queued. The function is then not called
/// again, and the state remains until the last copy is destroyed:
///
///   Callback<> callback(std::move(action));
///   world.schedule(time, callback);
///   return callback.subscription();
///
/// @tparam Arguments  types of the function's arguments
template <class... Arguments>
class Callback {
  public:
    /// Callback without a function. It is an error to call this Callback before a Callback with a
    /// function is assigned.
    Callback() = default;
    /// Callback with a function, which must not be empty.
    explicit Callback(std::function<void(Arguments...)> call)
        : state_(std::make_shared<State>(State{std::move(call)})) {}

    /// Calls the function, unless the callback was ended.
    void operator()(Arguments... arguments) const {
        if (!has_ended()) state_->call(arguments...);
    }
    /// Whether the callback was ended and may be removed.
    bool has_ended() const { return state_->ended; }
    /// Handle by which the user can end the callback.
    Subscription subscription() const {
        return Subscription(std::shared_ptr<bool>(state_, &state_->ended));
    }

  private:
    // User function, and flag whether the callback was ended. A Subscription has a shared pointer
    // to the flag, which also keeps the function alive.
    struct State {
        std::function<void(Arguments...)> call;
        bool ended = false;
    };
    // State that all copies of this Callback share; null for a Callback without a function.
    std::shared_ptr<State> state_;
};

}  // namespace rovernet
