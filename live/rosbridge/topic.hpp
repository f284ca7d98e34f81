// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Topics of a run: what ROS clients may subscribe to and publish.

namespace rovernet {

/// Time between two looks at what robots have heard. All periods but that of a scan are multiples.
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

/// Topic of the world, or one that each robot has.
struct RosTopicType {
    RosTopicKind kind;
    std::string_view name;  ///< without the leading "/"; of a robot's topic what follows its name
    std::string_view type;  ///< of its messages
    bool is_of_robot = true;
    bool is_input = false;  ///< published by clients
    /// Time between two messages; 0: one as soon as a client subscribes, or when something happens.
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

/// Type of messages that cmd_vel takes, too.
inline constexpr std::string_view stamped_velocity = "geometry_msgs/TwistStamped";

/// Topic as a client may name it.
struct RosTopic {
    const RosTopicType* type;
    NodeId robot = {};        ///< if it is a robot's
    std::size_t scanner = 0;  ///< of a scan: number among the range finders of the robot

    RosTopicKind kind() const { return type->kind; }
};

/// Whether a type is that of a topic; "pkg/msg/Type" is "pkg/Type".
bool is_type_of(const RosTopicType& topic, std::string_view type);
/// A type as this server writes it: "pkg/Type".
std::string plain_type(std::string_view type);
/// A name without its leading "/", which ROS clients give or leave out.
std::string_view plain_name(std::string_view name);
/// Robot to whose name a "/" and `rest` were added; none if there is no such robot.
std::optional<NodeId> robot_before(std::string_view name, std::string_view rest,
                                   const Network& network);

/// Topic of that name; none if there is none.
///
/// A robot has a scan for each range finder with evenly spaced beams: "/A/scan" for its first
/// laser, or for the first of them if it has no laser; "/A/rear/scan" for another, named "rear".
std::optional<RosTopic> find_topic(std::string_view name, const Session& session);
/// All topics, by kind and then by robot.
std::vector<RosTopic> all_topics(const Session& session);
/// Name of a topic: "/A/odom".
std::string name_of(const RosTopic& topic, const Session& session);

}  // namespace rovernet
