// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

// Services of a run that ROS clients can call.

namespace rovernet {

enum class RosServiceKind {
    radio_send,
    pause,
    unpause,
    step,
    set_pose,
    topics,
    services,
    nodes,
    topics_for_type,
    services_for_type,
    topic_type,
    service_type,
    message_details,
    topics_and_raw_types,
    parameter,
    parameter_names,
    publishers,
    subscribers,
    node_details,
    time,
};

/// Type of a ROS service: a service of the world, or a service that each robot has.
struct RosServiceType {
    RosServiceKind kind;
    /// Name of the service without the leading "/"; for a robot's service without the robot's name.
    std::string_view name;
    std::string_view type;
    std::string_view argument = {};  ///< name of the text argument; empty: no text argument
    bool is_of_robot = false;
};

inline constexpr std::array<RosServiceType, 20> ros_services = {{
    {RosServiceKind::radio_send, "radio/send", "rovernet_msgs/SendMessage", "", true},
    {RosServiceKind::pause, "simulation/pause", "std_srvs/Empty"},
    {RosServiceKind::unpause, "simulation/unpause", "std_srvs/Empty"},
    {RosServiceKind::step, "simulation/step", "rovernet_msgs/Step"},
    {RosServiceKind::set_pose, "simulation/set_pose", "rovernet_msgs/SetPose"},
    {RosServiceKind::topics, "rosapi/topics", "rosapi_msgs/Topics"},
    {RosServiceKind::services, "rosapi/services", "rosapi_msgs/Services"},
    {RosServiceKind::nodes, "rosapi/nodes", "rosapi_msgs/Nodes"},
    {RosServiceKind::topics_for_type, "rosapi/topics_for_type", "rosapi_msgs/TopicsForType",
     "type"},
    {RosServiceKind::services_for_type, "rosapi/services_for_type", "rosapi_msgs/ServicesForType",
     "type"},
    {RosServiceKind::topic_type, "rosapi/topic_type", "rosapi_msgs/TopicType", "topic"},
    {RosServiceKind::service_type, "rosapi/service_type", "rosapi_msgs/ServiceType", "service"},
    {RosServiceKind::message_details, "rosapi/message_details", "rosapi_msgs/MessageDetails",
     "type"},
    {RosServiceKind::topics_and_raw_types, "rosapi/topics_and_raw_types",
     "rosapi_msgs/TopicsAndRawTypes"},
    {RosServiceKind::parameter, "rosapi/get_param", "rosapi_msgs/GetParam", "name"},
    {RosServiceKind::parameter_names, "rosapi/get_param_names", "rosapi_msgs/GetParamNames"},
    {RosServiceKind::publishers, "rosapi/publishers", "rosapi_msgs/Publishers", "topic"},
    {RosServiceKind::subscribers, "rosapi/subscribers", "rosapi_msgs/Subscribers", "topic"},
    {RosServiceKind::node_details, "rosapi/node_details", "rosapi_msgs/NodeDetails", "node"},
    {RosServiceKind::time, "rosapi/get_time", "rosapi_msgs/GetTime"},
}};

/// ROS service that a client's request names.
struct RosService {
    const RosServiceType* type;
    NodeId robot = {};  ///< robot that has the service; unused for a service of the world

    RosServiceKind kind() const { return type->kind; }
};

/// Arguments of a call of a ROS service; the service determines which members are used.
struct RosArguments {
    std::string text = {};  ///< text argument of services with RosServiceType::argument
    std::optional<NodeId> robot = {};
    std::optional<RobotCommand> command = {};  ///< command for the robot of the service
    Duration time = {};                        ///< duration of a step of simulated time
};

class Network;
/// ROS service with this name; none if no service has the name.
std::optional<RosService> find_service(std::string_view name, const Network& network);

}  // namespace rovernet
