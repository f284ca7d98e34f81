// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"

#include <optional>
#include <vector>

namespace rovernet {

/// Position and heading in the plane.
struct Pose2d {
    double x = 0, y = 0;  ///< position [m]
    double heading = 0;   ///< heading [rad], counter-clockwise from the x axis
};

/// State of a robot that its Player devices share: the control of the robot, and its odometry.
class PlayerRobot {
  public:
    PlayerRobot(Session& session, NodeId robot);

    NodeId id() const { return id_; }
    Session& session() const { return session_; }
    double radius() const { return radius_; }  ///< radius of the robot [m]

    /// Executes a command for the robot, unless a program of a different protocol drives the robot.
    void carry_out(const RobotCommand& command);
    /// Stops the robot, after the last client that drove it has left.
    void release();
    /// Starts or stops storing received messages, unless a program of a different protocol drives
    /// the robot.
    void listen(bool listens);
    /// Messages that the robot received since the last call, while listen(true) is in effect.
    std::vector<HeardMessage> heard();

    /// Pose of the robot in the world.
    Pose2d pose() const;
    /// Pose of the robot by odometry, without errors: relative to the robot's pose at the start of
    /// the run, or to the origin that set_odometry() has set.
    Pose2d odometry() const;
    void set_odometry(const Pose2d& now);

  private:
    bool take();

    Session& session_;
    NodeId id_;
    double radius_;
    Pose2d origin_;  // origin of odometry, in the world
    std::optional<ClientId> client_;
    std::uint64_t commands_ = 0;
    bool is_driven_ = false, listens_ = false;
};

}  // namespace rovernet
