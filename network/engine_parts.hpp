// SPDX-License-Identifier: MIT
#pragma once

#include "network/few.hpp"
#include "network/network.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace rovernet {

/// What an event is about; `data` means what `kind` says.
struct Occurrence {
    enum class Kind : std::uint32_t {
        frame,
        router_timer,
        leg_end,
        handed_over,
        action,
        link_change,
        access_timer
    };
    Kind kind;
    NodeId node;
    std::uint64_t data;
};

/// A frame on its way to its receivers, some of which it may have reached already.
struct Flight {
    AirFrame air;
    std::uint32_t number = 0;    // among those of its sender, at the rung "sinr"
    std::uint64_t emission = 0;  // its serial on air, at rungs above threshold
    Medium::Receivers receivers;
    std::vector<Lock> locks;  // of the receptions, at the rung "sinr"
    std::size_t arrived = 0;
    bool undisturbed = false;  // who hears it gets it without errors
};

/// Shared, so that a callback keeps its state and outlives its being replaced while it runs.
template <class... Arguments>
using Callback = std::shared_ptr<std::function<void(Arguments...)>>;

struct Action {
    Callback<> call = nullptr;
    Duration period{0};
};

/// What an application says of a message.
struct Outgoing {
    std::uint32_t bytes;     ///< [bytes] on air
    std::uint32_t flow = 0;  ///< see Message
};

/// A node always has something to send.
struct Saturated {
    NodeId to;
    Outgoing what;
};

/// A robot's body and how it can move; those alike that were added in a row share one.
struct Body {
    Meters radius;
    MetersPerSecond top_speed;
    std::optional<RadiansPerSecond> turn_rate;
    friend bool operator==(const Body&, const Body&) = default;
};

/// What the network keeps of every robot beyond its name, its leg and its radio. There may be
/// millions: what only few robots have lies in tables of the engine.
struct Node {
    std::uint32_t body = 0;       // index into bodies_
    std::uint32_t movements = 0;  // begun so far
    Movement movement = {};
    Few<Callback<const Message&, const Heard&>> on_receive = {};
    std::uint32_t messages_sent = 0;
    std::uint32_t transmissions = 0;  // at the rung "sinr"
    bool moving = false;              // its movement has begun
};

}  // namespace rovernet
