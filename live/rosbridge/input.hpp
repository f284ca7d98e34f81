// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/json_object.hpp"
#include "live/rosbridge/topic.hpp"

#include <string>
#include <utility>

// Messages of ROS clients as commands of a session. Members that are left out are 0, as in ROS, but
// for those of a pose.
// Limits: 1,000 m/s and 1,000 rad/s, 1e9 m, data of 65,535 bytes.

namespace rovernet {

/// Command that a message to a robot's topic is, and what of it counts for nothing.
/// @param topic  an input
/// @throws RequestError
std::pair<RobotCommand, std::string> read_input(const JsonElement& message, const RosTopic& topic,
                                                const Network& network);

/// Message that a rovernet_msgs/Send says.
SendCommand read_send(const JsonElement& message, NodeId robot, const Network& network);

/// Robot of that name. @throws RequestError "unknown_robot"
NodeId read_robot(const JsonElement& name, const Network& network);

/// Command that puts a robot into a geometry_msgs/Pose. Without an orientation, or without the z of
/// its position, it keeps its own.
PlaceCommand read_place(const JsonElement& pose, NodeId robot, const Network& network);

}  // namespace rovernet
