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

/// Body and motion limits of a robot; consecutive robots with equal values share one.
struct Body {
    /// Radius of the body [m], for paths around walls.
    Meters radius;
    /// Speed limit of all movements [m/s]; may be infinite.
    MetersPerSecond top_speed;
    /// Rate of turning in place before the robot moves [rad/s]; empty: it turns instantly.
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
/// A movement model returns a leg when it begins, when a leg ends, and when the robot is first
/// switched on. Between these times only doors have an effect: a leg ends at a closed door, and the
/// movement then acts by its AtDoors. A robot touched by a closing door is caught: it stands until
/// the doors change and free it.
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
    /// the robot is switched on. Engine calls it whenever the run continues.
    void begin_all();
    /// Serves the event of the end of the leg with this version, unless the leg was replaced since.
    void on_leg_end(NodeId node, std::uint64_t version);

    /// Replaces the node's movement by another one, which begins now.
    void move(NodeId node, Movement movement);
    /// Puts a robot at another position at once, at rest; its movement ends.
    /// @param heading  heading there; unchanged if not given
    /// @throws std::invalid_argument for a coordinate that is not finite or beyond 1e15 m
    void place(NodeId node, Vec3 at, std::optional<Radians> heading = {});
    /// Stops a robot that was switched off, and stores its leg for resume().
    void pause(NodeId node);
    /// Continues the motion of a robot that was switched on: the rest of its leg takes as long as
    /// before.
    void resume(NodeId node);
    /// Handles a scene change now: stops robots at doors that have closed, and lets robots continue
    /// that waited.
    void scene_changed();
    /// Calls react() whenever the node ends a movement and rests, 1 us later.
    void on_arrival(NodeId node, Callback<> react) {
        on_arrival_[node].push_back(std::move(react));
    }

    /// Body of a node: radius and motion limits.
    /// @throws std::out_of_range if there is no such node
    const Body& body(NodeId node) { return bodies_[nodes_.at(node.index()).body]; }

  private:
    /// State of one robot. There may be millions of robots, so rare state is in the maps below.
    struct Moving {
        /// Index of the robot's body in bodies_.
        std::uint32_t body : 31 = 0;
        /// Whether the robot's movement has begun.
        std::uint32_t moving : 1 = 0;
        /// Number of movements that the robot had before its present one: part of the key of its
        /// draws.
        std::uint32_t movements = 0;
        Movement movement = {};
    };

    // Input of the movement model: position and body of the robot, path planner, random draws.
    Mover mover(NodeId node);
    // Asks the movement for the next leg, or begins the leg that waited for the end of a turn.
    void next_leg(NodeId node);
    // Begins a leg of the movement, after turning towards it if the robot turns in place.
    void begin_leg(NodeId node, const Leg& leg);
    // Removes all planned motion of the robot.
    void end_movement(NodeId node);
    // Begins a leg, up to the first closed door; go_to_doors() if there are closed doors.
    void go(NodeId node, const Leg& leg);
    void go_to_doors(NodeId node, const Leg& leg);
    // Continues the motion of a robot that waited for a door.
    void go_on(NodeId node);
    // Whether doors determine the next leg: the robot is caught, or has stopped at a door.
    bool is_held(NodeId node);
    // Whether a closed door touches the robot and stops it.
    bool is_caught(NodeId node);
    // Whether no closed door stops the robot at its position.
    bool is_free(NodeId node);
    // Whether the robot stands and waits for a door.
    bool waits(NodeId node) const;
    // Remaining part of a leg, joined with the part that waits behind it, which is removed.
    Leg rest_of(NodeId node, const Leg& leg);
    // Replaces the leg and emits Moved.
    void take(NodeId node, const Leg& leg);
    // Replaces the leg and notifies the other parts, without a record.
    void put(NodeId node, const Leg& leg);
    // Queues the event of the leg's end.
    void expect_leg_end(NodeId node);
    // Queues the reactions of callbacks that wait for the robot to come to rest.
    void tell_arrival(NodeId node);

    World& world_;
    Channel& channel_;
    LinkMonitor& links_;
    // Robots by node.
    Chunks<Moving> nodes_;
    // Bodies; each differs from the one before.
    std::vector<Body> bodies_;
    // Legs interrupted by switching off.
    std::map<NodeId, Leg> interrupted_;
    // Legs that begin after the turn on the current leg.
    std::map<NodeId, Leg> after_turn_;
    // Remaining legs that wait for a door, from the robot's stop; empty: the movement is asked for
    // a new leg.
    std::map<NodeId, std::optional<Leg>> held_;
    // Callbacks by node.
    std::map<NodeId, std::vector<Callback<>>> on_arrival_;
    // Number of nodes whose movement has begun: the first ones.
    std::size_t begun_ = 0;
    // Nodes that need an event during begin_all(); events are queued in the order of their keys.
    std::vector<NodeId> set_off_;
    bool beginning_ = false;
};

}  // namespace rovernet
