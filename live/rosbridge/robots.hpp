// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/front.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Robots shared by all ROS clients: any ROS client may command any robot, and get the messages
/// that the robot has received.
class RosRobots {
  public:
    explicit RosRobots(Session& session) : session_(session) {}

    /// Takes control of a robot for all ROS clients until the run ends; no effect if ROS clients
    /// have control already.
    /// @throws RequestError "taken" if a program that uses another protocol drives the robot
    void take(NodeId robot);
    /// Whether ROS clients control at least one robot. If so, heard() must be called regularly.
    bool any() const { return !clients_.empty(); }

    /// Executes a ROS client's command. @return uid of the sent message; none: no message was sent
    /// @throws RequestError "taken", "no_room"
    std::optional<std::uint64_t> carry_out(NodeId robot, const RobotCommand& command,
                                           Front::Connection by);
    /// Handles a client that has left: stops the robots that the client was the last to drive.
    void left(Front::Connection client);

    /// Messages that robots of ROS clients received since the last call, in order of time, then of
    /// robot.
    std::vector<HeardMessage> heard();
    /// Time of the last message that robot `at` received in a frame of robot `last_hop`; none: no
    /// message yet.
    std::optional<Time> last_heard(NodeId at, NodeId last_hop) const;

  private:
    Session& session_;
    std::map<NodeId, ClientId> clients_;
    std::map<NodeId, Front::Connection> drivers_;
    std::map<std::pair<NodeId, NodeId>, Time> last_heard_;  // times by receiver and sender
    std::uint64_t commands_ = 0;
};

}  // namespace rovernet
