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

/// Body of a robot, and how it can move; robots alike that were added in a row share one.
struct Body {
    /// Radius [m], for ways around walls.
    Meters radius;
    /// Speed that no movement exceeds [m/s]; may be infinite.
    MetersPerSecond top_speed;
    /// Rate of turning in place before it moves off [rad/s]; none: it turns at once.
    std::optional<RadiansPerSecond> turn_rate;
    friend bool operator==(const Body&, const Body&) = default;
};

/// Motion of all robots: one leg after the other, as their movement models say.
///
///   begin_all --> next_leg --> movement answers --> take: Legs, Channel, Medium, links; Moved
///                    ^          a leg                        |
///                    +------------- on_leg_end <-------------+   an event at the leg's end
///
/// A movement is asked for a leg when it begins, when a leg ends, and when the robot is switched on
/// for the first time. Nothing happens in between, but for doors: a leg goes as far as the closed
/// doors let it, and movements do what their AtDoors says. A robot that a closing door touches is
/// caught: it stands until a change of the doors frees it.
class Motion {
  public:
    /// @param channel  told before a leg changes, and what the new one is
    /// @param links    told after that
    Motion(World& world, Channel& channel, LinkMonitor& links)
        : world_(world), channel_(channel), links_(links) {}

    /// Checks the body, heading and place of a robot before it is added.
    /// @throws std::invalid_argument for a parameter out of its range
    static void check(const Robot& robot);
    /// Adds the next node, which stands still until begin_all().
    NodeId add(Robot robot);
    /// Begins the movements that have not begun. A robot that is off stands; its movement begins
    /// when it is switched on. Engine calls it whenever the run goes on.
    void begin_all();
    /// Serves the event of a leg's end, unless another leg has taken its place: the versions differ
    /// then.
    void on_leg_end(NodeId node, std::uint64_t version);

    /// Replaces the node's movement, now.
    void move(NodeId node, Movement movement);
    /// Puts a robot somewhere else at once, at rest; its movement is over.
    /// @param heading  that it has there; as before if not given
    /// @throws std::invalid_argument for a coordinate that is not finite or beyond 1e15 m
    void place(NodeId node, Vec3 at, std::optional<Radians> heading = {});
    /// Stops a robot that was switched off, and keeps its leg.
    void pause(NodeId node);
    /// Moves a robot on that was switched on: what is left of its leg takes as long as before.
    void resume(NodeId node);
    /// Takes note that the scene has changed just now: stops robots at doors that have closed, and
    /// moves on those that waited.
    void scene_changed();
    /// Calls react() whenever the node comes to rest at the end of a movement, 1 us later.
    void on_arrival(NodeId node, Callback<> react) {
        on_arrival_[node].push_back(std::move(react));
    }

    /// Body of a node.
    /// @throws std::out_of_range if there is no such node
    const Body& body(NodeId node) { return bodies_[nodes_.at(node.index()).body]; }

  private:
    /// State of one robot. There may be millions: what only few robots have lies in the maps below.
    struct Moving {
        /// Index into bodies_.
        std::uint32_t body : 31 = 0;
        /// Its movement has begun.
        std::uint32_t moving : 1 = 0;
        /// Number of movements that were replaced so far: part of the key of its draws.
        std::uint32_t movements = 0;
        Movement movement = {};
    };

    // View of a robot that its movement model gets: where it is, its body, the planner, its draws.
    Mover mover(NodeId node);
    // Asks the movement for the next leg, or begins the one that waits for a turn to end.
    void next_leg(NodeId node);
    // Takes a leg of the movement, after turning towards it if the robot turns in place.
    void begin_leg(NodeId node, const Leg& leg);
    // Forgets what the robot was about to do.
    void end_movement(NodeId node);
    // Takes a leg of the movement as far as closed doors let it; the second if there are some.
    void go(NodeId node, const Leg& leg);
    void go_to_doors(NodeId node, const Leg& leg);
    // Moves a robot on that waited for a door.
    void go_on(NodeId node);
    // Whether doors decide on the next leg: that of a robot that is caught, or has come to one.
    bool is_held(NodeId node);
    // Whether a closed door touches the robot, and stops it.
    bool is_caught(NodeId node);
    // Whether no closed door keeps a robot that stands where it is.
    bool is_free(NodeId node);
    // Whether it waits for a door, standing.
    bool waits(NodeId node) const;
    // What is left of a leg, and of the rest that waits behind it; that does not wait any more.
    Leg rest_of(NodeId node, const Leg& leg);
    // Replaces the leg and emits Moved.
    void take(NodeId node, const Leg& leg);
    // Replaces the leg and tells those who have to know, without a record.
    void put(NodeId node, const Leg& leg);
    // Queues the event of the leg's end.
    void expect_leg_end(NodeId node);
    // Lets those react who wait for the robot to come to rest.
    void tell_arrival(NodeId node);

    World& world_;
    Channel& channel_;
    LinkMonitor& links_;
    // Robots by node.
    Chunks<Moving> nodes_;
    // Bodies that differ from the one before.
    std::vector<Body> bodies_;
    // Legs that switching off interrupted.
    std::map<NodeId, Leg> interrupted_;
    // Legs that begin when the turn on the current leg is over.
    std::map<NodeId, Leg> after_turn_;
    // Rests of legs that wait for a door, from where the robot stops; nothing: the movement is
    // asked for another leg.
    std::map<NodeId, std::optional<Leg>> held_;
    // Callbacks by node.
    std::map<NodeId, std::vector<Callback<>>> on_arrival_;
    // Nodes whose movement has begun: the first so many.
    std::size_t begun_ = 0;
    // Nodes that need an event while begin_all() is at work; they get it in the order of their
    // keys.
    std::vector<NodeId> set_off_;
    bool beginning_ = false;
};

}  // namespace rovernet
