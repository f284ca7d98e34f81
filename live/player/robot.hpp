// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"

#include <optional>
#include <vector>

namespace rovernet {

/// Place and direction in the plane.
struct Pose2d {
    double x = 0, y = 0;  ///< [m]
    double heading = 0;   ///< [rad], counter-clockwise from the x axis
};

/// Robot as the Player devices of it have it in common: what drives it, and its odometry.
class PlayerRobot {
  public:
    PlayerRobot(Session& session, NodeId robot);

    NodeId id() const { return id_; }
    Session& session() const { return session_; }
    double radius() const { return radius_; }  ///< [m]

    /// Carries out a command, unless another program drives the robot.
    void carry_out(const RobotCommand& command);
    /// Stops, as the last client that drove it has left.
    void let_go();
    /// Begins or ends to keep the messages that it hears, unless another program drives the robot.
    void listen(bool listens);
    /// Messages that it heard since the last call, while it listens.
    std::vector<HeardMessage> heard();

    /// Pose in the world.
    Pose2d pose() const;
    /// Pose by odometry, without errors: from where it was when the run began, or as it was set.
    Pose2d odometry() const;
    void set_odometry(const Pose2d& now);

  private:
    bool take();

    Session& session_;
    NodeId id_;
    double radius_;
    Pose2d origin_;  // of odometry, in the world
    std::optional<ClientId> client_;
    std::uint64_t commands_ = 0;
    bool is_driven_ = false, listens_ = false;
};

}  // namespace rovernet
