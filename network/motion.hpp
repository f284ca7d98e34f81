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

/// Body and motion limits of a robot; consecutive robots with equal values share one Body.
struct Body {
    /// Radius of the body [m], for paths around walls.
    Meters radius;
    /// Speed limit of all movements but recorded ones [m/s]; may be infinite.
    MetersPerSecond top_speed;
    /// Rate of turning in place before the robot moves [rad/s]; empty: the robot turns instantly.
    std::optional<RadiansPerSecond> turn_rate;
    friend bool operator==(const Body&, const Body&) = default;
};

/// Motion of all robots: a sequence of legs, made by their movement models. A leg is a straight
/// movement at constant speed, or a rest, from one time to another.
///
///   begin_all --> next_leg --> movement answers --> take: Legs, Channel, Medium, links; Moved
///                    ^          a leg                        |
///                    +------------- on_leg_end <-------------+   an event at the leg's end
///
/// A movement model returns a leg when the movement begins, when a leg ends, and when the robot is
/// first switched on. Between these times only doors change the motion: a leg ends at a closed
/// door, and the movement's AtDoors determines the next leg. A robot that a closing door touches is
/// caught: the robot stands until a later change of the doors frees it.
class Motion {
  public:
    /// @param channel  notified before a leg changes, and then of the new leg
    /// @param links    notified of the new leg after the channel
    Motion(World& world, Channel& channel, LinkMonitor& links)
        : world_(world), channel_(channel), links_(links) {}

    /// Checks body, heading and position of a robot before it is added.
    /// @throws std::invalid_argument for a parameter out of its range
    static void check(const Robot& robot);
    /// Adds the next node, which stands still until begin_all().
    NodeId add(Robot robot);
    /// Begins the movements that have not begun. The movement of a robot that is off begins when
    /// the robot is switched on. Engine calls begin_all() whenever the run continues.
    void begin_all();
    /// Serves the event of the end of a leg: begins the next leg, unless the leg with this version
    /// was replaced since the event was queued.
    void on_leg_end(NodeId node, std::uint64_t version);

    /// Replaces the node's movement by `movement`, which begins now.
    void move(NodeId node, Movement movement);
    /// Moves a robot immediately to the position `at` [m], where it rests; its movement ends.
    /// @param heading  heading at the new position [rad]; unchanged if not given
    /// @throws std::invalid_argument for a coordinate that is not finite or beyond 1e15 m
    void place(NodeId node, Vec3 at, std::optional<Radians> heading = {});
    /// Stops a robot that was switched off, and stores the robot's leg for resume().
    void pause(NodeId node);
    /// Continues the motion of a robot that was switched on: the remaining time of the interrupted
    /// leg is the same as when the robot was switched off.
    void resume(NodeId node);
    /// Handles a scene change now: stops robots at doors that have closed, and lets robots continue
    /// that waited at doors now open.
    void scene_changed();
    /// Calls react() 1 us after each time that the node ends a movement and rests.
    void on_arrival(NodeId node, Callback<> react) {
        on_arrival_[node].push_back(std::move(react));
    }

    /// Body of a node: radius and motion limits.
    /// @throws std::out_of_range if there is no such node
    const Body& body(NodeId node) { return bodies_[nodes_.at(node.index()).body]; }
    /// Number of movements that a node was given by move() and place().
    std::uint32_t movements(NodeId node) { return nodes_.at(node.index()).movements; }

  private:
    /// State of one robot's motion. There may be millions of robots, so rare state is in maps of
    /// Motion.
    struct Moving {
        /// Index of the robot's body in bodies_.
        std::uint32_t body : 31 = 0;
        /// Whether the robot's movement has begun.
        std::uint32_t moving : 1 = 0;
        /// Number of movements that the robot had before its present movement: part of the key of
        /// the movement's random draws.
        std::uint32_t movements = 0;
        Movement movement = {};
    };

    // Input of the movement model: position and body of the robot, path planner, random draws.
    Mover mover(NodeId node);
    // Begins the next leg: the leg that waited for the end of a turn, or a new leg of the movement
    // model.
    void next_leg(NodeId node);
    // Begins a leg of the movement model; a robot that turns in place first turns towards the leg.
    void begin_leg(NodeId node, const Leg& leg);
    // Ends the robot's movement, and removes its interrupted and waiting legs.
    void end_movement(NodeId node);
    // Begin a leg. If the scene has closed doors, go() calls go_to_doors(), which ends the leg at
    // the first closed door.
    void go(NodeId node, const Leg& leg);
    void go_to_doors(NodeId node, const Leg& leg);
    // Continues the motion of a robot that waited for a door.
    void go_on(NodeId node);
    // Whether doors determine the robot's next leg: the robot is caught, or has stopped at a door.
    bool is_held(NodeId node);
    // Whether a closed door touches the robot and stops it.
    bool is_caught(NodeId node);
    // Whether the robot can move: no closed door touches the robot or stops its waiting leg.
    bool is_free(NodeId node);
    // Whether the robot stands and waits for a door.
    bool waits(NodeId node) const;
    // Remaining part of a leg, joined with the part behind a door that waits in held_. Removes that
    // waiting part from held_.
    Leg rest_of(NodeId node, const Leg& leg);
    // Replaces the robot's current leg, notifies channel, medium and link monitor, and emits Moved.
    void take(NodeId node, const Leg& leg);
    // Replaces the robot's current leg, notifies channel, medium and link monitor, without a
    // record.
    void put(NodeId node, const Leg& leg);
    // Queues the event of the end of the robot's current leg.
    void expect_leg_end(NodeId node);
    // Queues the callbacks of on_arrival() for a robot that has come to rest.
    void tell_arrival(NodeId node);

    World& world_;
    Channel& channel_;
    LinkMonitor& links_;
    // State of each robot's motion, by node.
    Chunks<Moving> nodes_;
    // Bodies of robots, by Moving::body; each differs from the previous one.
    std::vector<Body> bodies_;
    // Legs that were interrupted when their robot was switched off, by node.
    std::map<NodeId, Leg> interrupted_;
    // Legs that begin when the robot's current leg, a turn in place, ends; by node.
    std::map<NodeId, Leg> after_turn_;
    // Rests of legs of robots that wait for doors, by node; each continues when the doors let the
    // robot pass. Empty: the movement model then returns a new leg.
    std::map<NodeId, std::optional<Leg>> held_;
    // Callbacks of on_arrival(), by node.
    std::map<NodeId, std::vector<Callback<>>> on_arrival_;
    // Number of nodes that begin_all() has handled: the nodes with the lowest ids.
    std::size_t begun_ = 0;
    // Nodes for which begin_all() has to queue an event; events are queued in the order of the
    // nodes' keys.
    std::vector<NodeId> set_off_;
    bool beginning_ = false;
};

}  // namespace rovernet
