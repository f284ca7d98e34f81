// SPDX-License-Identifier: MIT
#pragma once

#include "network/subscription.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace rovernet {

/// User function that the network calls until its Subscription is ended.
///
/// Copies share the function and its state. A callback may be ended while it runs, or while an
/// event for it is queued: its state is kept until then, and it is not called again:
///
///   Callback<> callback(std::move(action));
///   world.schedule(time, callback);
///   return callback.subscription();
///
/// @tparam Arguments  arguments of the function
template <class... Arguments>
class Callback {
  public:
    /// Callback without a function, to be assigned later; calling it is an error.
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
    // Function and end flag. A Subscription points to the flag and keeps both alive.
    struct State {
        std::function<void(Arguments...)> call;
        bool ended = false;
    };
    // Null for a callback without a function.
    std::shared_ptr<State> state_;
};

}  // namespace rovernet
