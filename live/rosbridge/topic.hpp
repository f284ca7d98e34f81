// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Topics of a run, to which ROS clients can subscribe and publish.

namespace rovernet {

/// Interval at which messages received by robots are fetched. Periods of topics, except for scans,
/// are multiples of this interval.
inline constexpr Duration ros_tick = std::chrono::milliseconds(10);

enum class RosTopicKind {
    clock,
    transforms,
    static_transforms,
    map,
    odometry,
    scan,
    received,
    neighbors,
    velocity,
    goal,
    send,
};

/// Type of a ROS topic: a topic of the world, or a topic that each robot has.
struct RosTopicType {
    RosTopicKind kind;
    /// Name of the topic without the leading "/"; for a robot's topic without the robot's name.
    std::string_view name;
    std::string_view type;  ///< message type of the topic
    bool is_of_robot = true;
    bool is_input = false;  ///< true: clients publish to the topic; false: clients subscribe
    /// Interval between messages of the topic; 0: one message on subscription, or one for each
    /// event.
    Duration period = {};
};

inline constexpr std::array<RosTopicType, 11> ros_topics = {{
    {RosTopicKind::clock, "clock", "rosgraph_msgs/Clock", false, false, ros_tick},
    {RosTopicKind::transforms, "tf", "tf2_msgs/TFMessage", false, false, 5 * ros_tick},
    {RosTopicKind::static_transforms, "tf_static", "tf2_msgs/TFMessage", false},
    {RosTopicKind::map, "map", "nav_msgs/OccupancyGrid", false},
    {RosTopicKind::odometry, "odom", "nav_msgs/Odometry", true, false, 5 * ros_tick},
    {RosTopicKind::scan, "scan", "sensor_msgs/LaserScan"},
    {RosTopicKind::received, "radio/received", "rovernet_msgs/Received"},
    {RosTopicKind::neighbors, "radio/neighbors", "rovernet_msgs/Neighbors", true, false,
     10 * ros_tick},
    {RosTopicKind::velocity, "cmd_vel", "geometry_msgs/Twist", true, true},
    {RosTopicKind::goal, "goal_pose", "geometry_msgs/PoseStamped", true, true},
    {RosTopicKind::send, "radio/send", "rovernet_msgs/Send", true, true},
}};

/// Message type that the topic cmd_vel accepts besides geometry_msgs/Twist.
inline constexpr std::string_view stamped_velocity = "geometry_msgs/TwistStamped";

/// ROS topic that a client's request names.
struct RosTopic {
    const RosTopicType* type;
    NodeId robot = {};        ///< robot that has the topic; unused for a topic of the world
    std::size_t scanner = 0;  ///< index of the robot's range finder, for a topic `scan`

    RosTopicKind kind() const { return type->kind; }
};

/// Whether a topic has this message type. "pkg/msg/Type" means the same type as "pkg/Type".
bool is_type_of(const RosTopicType& topic, std::string_view type);
/// Message type converted to the form "pkg/Type".
std::string plain_type(std::string_view type);
/// Name of a topic or service without a leading "/", which is optional in ROS names.
std::string_view plain_name(std::string_view name);
/// Robot in a topic name of the form ROBOT/`rest`; none if the name has another form or no robot
/// has the name ROBOT.
std::optional<NodeId> robot_before(std::string_view name, std::string_view rest,
                                   const Network& network);

/// ROS topic with this name; none if no topic has the name.
///
/// A robot has a scan topic for each range finder with evenly spaced beams: "/A/scan" for its first
/// laser, or for its first range finder if it has no laser; "/A/rear/scan" for a range finder named
/// "rear".
std::optional<RosTopic> find_topic(std::string_view name, const Session& session);
/// All ROS topics, in order of kind, then of robot.
std::vector<RosTopic> all_topics(const Session& session);
/// Name of a ROS topic: "/A/odom".
std::string name_of(const RosTopic& topic, const Session& session);

}  // namespace rovernet
