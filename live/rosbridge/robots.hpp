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

/// Robots as ROS clients have them in common: any of them may command any robot, and listen to it.
class RosRobots {
  public:
    explicit RosRobots(Session& session) : session_(session) {}

    /// Takes a robot for all clients, once and for good.
    /// @throws RequestError "taken" if another program drives it
    void take(NodeId robot);
    /// Some robots are taken: what they hear has to be fetched now and then.
    bool any() const { return !clients_.empty(); }

    /// Carries out a command of a client. @return as Session::carry_out(). @throws RequestError
    /// "taken"
    std::optional<std::uint64_t> carry_out(NodeId robot, const RobotCommand& command,
                                           Front::Connection by);
    /// A client has gone: robots that it was the last to drive stop.
    void left(Front::Connection client);

    /// Messages that the robots heard since the last call, in order of time and then of robot.
    std::vector<HeardMessage> heard();
    /// Time of the last message that a robot heard by a frame of another; none: it heard none yet.
    std::optional<Time> last_heard(NodeId at, NodeId last_hop) const;

  private:
    Session& session_;
    std::map<NodeId, ClientId> clients_;
    std::map<NodeId, Front::Connection> drivers_;
    std::map<std::pair<NodeId, NodeId>, Time> last_heard_;  // by receiver and sender
    std::uint64_t commands_ = 0;
};

}  // namespace rovernet
