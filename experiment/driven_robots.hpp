// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "mobility/driven.hpp"
#include "network/network.hpp"

#include <map>
#include <memory>

namespace rovernet {

/// Speed of a robot as its own sensors would tell it.
struct Twist {
    double speed = 0;      ///< ahead [m/s], < 0: backwards
    double turn_rate = 0;  ///< [rad/s], counter-clockwise
};

/// Robots of a network that are told from outside how to move, and how far they do it.
class DrivenRobots {
  public:
    explicit DrivenRobots(Network& network) : network_(network) {}

    void carry_out(NodeId robot, const DriveCommand& command);
    void carry_out(NodeId robot, const GoalCommand& command);
    void carry_out(NodeId robot, const StopCommand& command);
    void carry_out(NodeId robot, const PlaceCommand& command);
    /// Gives a robot any other movement.
    void move(NodeId robot, Movement movement);

    /// The robot was told to drive ahead and cannot.
    bool is_stalled(NodeId robot) const;
    /// Speed of a robot: as it is driven, or else that of its leg.
    Twist twist(NodeId robot) const;

  private:
    /// Robot that is driven by a velocity.
    struct Driving {
        Time until;
        double speed;  // [m/s] as commanded
        std::shared_ptr<DrivenArc> arc;
    };
    const Driving* driving(NodeId robot) const;

    Network& network_;
    std::map<NodeId, Driving> driving_;
};

}  // namespace rovernet
