// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "mobility/driven.hpp"
#include "network/network.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <variant>

namespace rovernet {

/// Robots of a network that external commands steer, and the state of each robot's last command.
class DrivenRobots {
  public:
    explicit DrivenRobots(Network& network);
    DrivenRobots(const DrivenRobots&) = delete;
    DrivenRobots& operator=(const DrivenRobots&) = delete;

    // Actions of robot commands; the function carry_out() of a command calls its action.

    /// Makes a robot drive ahead and turn. @param timeout  time until the robot stops [ns]; none:
    /// no limit
    void drive(NodeId robot, MetersPerSecond speed, RadiansPerSecond turn_rate,
               std::optional<Duration> timeout);
    /// Lets a robot drive to a point, around the walls.
    void go(NodeId robot, Vec3 to, MetersPerSecond speed);
    void stop(NodeId robot);
    /// Moves a robot to the position `at` [m] in zero time; the robot then rests.
    void place(NodeId robot, Vec3 at, Radians heading);
    Network& network() { return network_; }

    /// Gives a robot any movement, which replaces its last command.
    void move(NodeId robot, Movement movement);

    /// Whether the robot stands still although its command is to drive ahead, since an obstacle
    /// (such as a wall) blocks the robot.
    bool is_stalled(NodeId robot) const;
    /// Whether the robot stands still since no path reaches the goal of its command.
    bool has_no_way(NodeId robot) const;
    /// Velocity of a robot in the robot's coordinate frame: the commanded velocity while a drive
    /// command is active; otherwise the velocity of the current leg (piece of movement).
    Twist twist(NodeId robot) const;

  private:
    /// Drive command of a robot, with its end.
    struct Driving {
        Time until;
        double speed;  // commanded speed [m/s]
        std::shared_ptr<DrivenArc> arc;
    };
    const Driving* driving(NodeId robot) const;
    void forget(NodeId robot);

    /// Sink that collects the robots that found no path to a goal.
    struct NoWays {
        std::set<NodeId> robots = {};

        KindMask kinds() const { return kind_of<NoWay>(); }
        void on(const Record& record, const RecordContext&) {
            robots.insert(std::get<NoWay>(record).node);
        }
    };

    Network& network_;
    std::map<NodeId, Driving> driving_;
    std::shared_ptr<NoWays> no_ways_ = std::make_shared<NoWays>();
};

}  // namespace rovernet
