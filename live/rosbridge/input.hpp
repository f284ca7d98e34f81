// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/json_object.hpp"
#include "live/rosbridge/topic.hpp"

#include <string>
#include <utility>

// Conversion of messages of ROS clients into commands of a session. Missing members are 0, as in
// ROS, except in a pose. Limits: speeds of 1,000 m/s and 1,000 rad/s, coordinates of 1e9 m, data of
// 65,535 bytes.

namespace rovernet {

/// Robot command for a ROS message published to a robot's topic, and a text naming ignored members.
/// @param topic  topic to which clients publish
/// @throws RequestError
std::pair<RobotCommand, std::string> read_input(const JsonElement& message, const RosTopic& topic,
                                                const Network& network);

/// Send command for a message of type rovernet_msgs/Send.
SendCommand read_send(const JsonElement& message, NodeId robot, const Network& network);

/// Robot with this name. @throws RequestError "unknown_robot"
NodeId read_robot(const JsonElement& name, const Network& network);

/// Command that teleports a robot to a geometry_msgs/Pose. A robot keeps its current heading if the
/// pose has no orientation, and its current height if the pose has no z.
PlaceCommand read_place(const JsonElement& pose, NodeId robot, const Network& network);

}  // namespace rovernet
