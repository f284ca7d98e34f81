// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "network/callback.hpp"
#include "network/channel.hpp"
#include "network/link_monitor.hpp"
#include "network/network.hpp"
#include "sim/chunks.hpp"
#include "sim/legs.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

struct World;

/// A robot's body and how it can move; those alike that were added in a row share one.
struct Body {
    Meters radius;
    MetersPerSecond top_speed;
    std::optional<RadiansPerSecond> turn_rate;
    friend bool operator==(const Body&, const Body&) = default;
};

/// Where robots go: one leg after the other, as their movement models say.
class Motion {
  public:
    Motion(World& world, Channel& channel, LinkMonitor& links)
        : world_(world), channel_(channel), links_(links) {}

    /// @throws std::invalid_argument for a parameter out of its range
    static void check(const Robot& robot);
    /// Adds the next node, which stands still until begin_all().
    NodeId add(Robot robot);
    /// Begins the movements that have not begun.
    void begin_all();
    /// Serves the event of a leg's end, unless another leg has taken its place.
    void on_leg_end(NodeId node, std::uint64_t version);

    /// Replaces the node's movement, now.
    void move(NodeId node, Movement movement);
    /// Puts a robot somewhere else at once, at rest; its movement is over.
    void place(NodeId node, Vec3 at);
    /// The robot was switched off: it stands still. Or on: it goes on.
    void pause(NodeId node);
    void resume(NodeId node);
    void on_arrival(NodeId node, Callback<> react) {
        on_arrival_[node].push_back(std::move(react));
    }

    /// @throws std::out_of_range if there is no such node
    const Body& body(NodeId node) { return bodies_[nodes_.at(node.index()).body]; }

  private:
    /// There may be millions: what only few robots have lies in the maps below.
    struct Moving {
        std::uint32_t body : 31 = 0;   // index into bodies_
        std::uint32_t moving : 1 = 0;  // its movement has begun
        std::uint32_t movements = 0;   // begun so far
        Movement movement = {};
    };

    Mover mover(NodeId node);
    void next_leg(NodeId node);
    void begin_leg(NodeId node, const Leg& leg);
    void end_movement(NodeId node);
    void take(NodeId node, const Leg& leg);
    void put(NodeId node, const Leg& leg);
    void expect_leg_end(NodeId node);
    void tell_arrival(NodeId node);

    World& world_;
    Channel& channel_;
    LinkMonitor& links_;
    Chunks<Moving> nodes_;
    std::vector<Body> bodies_;
    std::map<NodeId, Leg> interrupted_;  // by switching off
    std::map<NodeId, Leg> after_turn_;   // begins when the turn on the current leg is over
    std::map<NodeId, std::vector<Callback<>>> on_arrival_;
    std::size_t begun_ = 0;        // nodes whose movement has begun
    std::vector<NodeId> set_off_;  // of them, those that something comes of ...
    bool beginning_ = false;       // ... while movements begin
};

}  // namespace rovernet
