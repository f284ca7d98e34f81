// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

// Commands from external programs to robots. A Session executes commands; an input log stores
// commands.
//
// The fields() of a command define its keys and their ranges in the lock-step protocol, in the log
// of inputs, in ROS messages and in Python. Positions and payloads must be given. Other fields have
// defaults. Each command except SendCommand has a function carry_out(), which calls the function of
// DrivenRobots that moves the robot.

namespace rovernet {

inline constexpr Range drive_speeds{.low = -1000, .high = 1000, .text = "from -1000 to 1000 m/s"};
inline constexpr Range drive_turns{.low = -1000, .high = 1000, .text = "from -1000 to 1000 rad/s"};
inline constexpr Range drive_times{.low = 0, .low_included = false, .text = "> 0 s"};

/// Command to drive ahead and turn until the next command, see the movement Driven.
struct DriveCommand {
    static constexpr std::string_view name = "drive";

    MetersPerSecond speed{0};       ///< speed ahead [m/s], < 0: backwards
    RadiansPerSecond turn_rate{0};  ///< turn rate [rad/s], counter-clockwise
    /// Time after which the robot stops [ns]; none: the robot does not stop.
    std::optional<Duration> timeout = {};

    static constexpr auto fields() {
        return describe(field("v", &DriveCommand::speed, drive_speeds, "speed"),
                        field("w", &DriveCommand::turn_rate, drive_turns, "turn rate"),
                        field("timeout", &DriveCommand::timeout, drive_times, "timeout"));
    }
    void carry_out(auto& robots, NodeId robot) const {
        robots.drive(robot, speed, turn_rate, timeout);
    }
};

inline constexpr Range goal_speeds{
    .low = 0, .high = 1000, .low_included = false, .text = "above 0 and up to 1000 m/s"};
inline constexpr Range goal_places{.low = -1e9, .high = 1e9, .text = "from -1e9 to 1e9 m"};

/// Command to drive to a point, around the walls, and to stop there.
struct GoalCommand {
    static constexpr std::string_view name = "goal";

    Vec3 to;                   ///< position of the goal [m]
    MetersPerSecond speed{1};  ///< speed of the robot [m/s], > 0

    static constexpr auto fields() {
        return describe(field("goal", &GoalCommand::to, goal_places, "goal"),
                        field("speed", &GoalCommand::speed, goal_speeds, "speed"));
    }
    void carry_out(auto& robots, NodeId robot) const { robots.go(robot, to, speed); }
};

/// Command to a robot to stop and stand still.
struct StopCommand {
    static constexpr std::string_view name = "stop";

    static constexpr auto fields() { return describe(); }
    void carry_out(auto& robots, NodeId robot) const { robots.stop(robot); }
};

/// Command that moves the robot to a new position in zero time (teleport); the robot then rests.
struct PlaceCommand {
    static constexpr std::string_view name = "place";

    Vec3 at;          ///< new position [m]
    Radians heading;  ///< new heading [rad], counter-clockwise from the x axis

    static constexpr auto fields() {
        return describe(field("place", &PlaceCommand::at, goal_places, "place"),
                        field("heading", &PlaceCommand::heading, "heading"));
    }
    void carry_out(auto& robots, NodeId robot) const { robots.place(robot, at, heading); }
};

inline constexpr Range message_sizes{.low = 0, .high = longest_message, .text = "65507 at most"};

/// Command to send a message, see Network::send.
struct SendCommand {
    static constexpr std::string_view name = "send";

    std::optional<NodeId> to = {};  ///< destination; none: everyone
    std::uint16_t port = 0;         ///< destination port, which selects a program at the receiver
    std::string payload = {};
    std::optional<std::uint32_t> size = {};  ///< size on air [bytes]; none: length of the payload
    bool one_hop = false;                    ///< true: the message goes over one hop, without the
                                             ///< routing protocol

    static constexpr auto fields() {
        return describe(field("to", &SendCommand::to, "destination"),
                        field("port", &SendCommand::port, "port"),
                        field("data", &SendCommand::payload, message_sizes, "message"),
                        field("size", &SendCommand::size, message_sizes, "size"),
                        field("one_hop", &SendCommand::one_hop, "over one hop"));
    }
};

/// Command of a client (external program) to a robot.
using RobotCommand =
    std::variant<DriveCommand, GoalCommand, StopCommand, PlaceCommand, SendCommand>;

/// Name of a command, such as "goal".
std::string_view name_of(const RobotCommand& command);

/// Checks the fields of a command against their ranges.
/// @param robot  name of the robot, for the error
/// @throws std::invalid_argument that names field, robot, range and value
void check(const RobotCommand& command, std::string_view robot);

inline constexpr Duration shortest_step{
    1'000};  ///< shortest step [ns] that a lock-step controller may request

/// Input of a run: an accepted command of a client, with its time. The scenario and all inputs
/// together reproduce a run.
struct Input {
    Time time;
    NodeId robot;
    std::string client;        ///< name of the client that gave the command
    std::uint64_t number = 0;  ///< number that the client gave to the command
    RobotCommand command;
};

/// Id of a client (external program) of a Session.
using ClientId = std::uint32_t;

/// Message that a client's robot received.
struct HeardMessage {
    Time time;    ///< time of delivery to the robot [ns], 1 us after the end of reception
    NodeId at;    ///< robot that received the message
    NodeId from;  ///< robot that sent the message (its origin)
    int hops;     ///< number of hops from the origin to the robot `at`, from 1
    std::string payload;
    NodeId last_hop = {};           ///< transmitter of the frame that brought the message
    std::optional<Dbm> level = {};  ///< received level of the message's frame [dBm]; none if the
                                    ///< frame was on air before the first client joined
    std::uint16_t port = 0;         ///< destination port given by the sending client; 0: none
    bool is_for_everyone = true;    ///< true: a broadcast; false: a unicast to the robot `at`
    friend bool operator==(const HeardMessage&, const HeardMessage&) = default;
};

/// Velocity of a robot in the robot's coordinate frame, as odometry would measure it.
struct Twist {
    double speed = 0;      ///< speed ahead [m/s], < 0: backwards
    double turn_rate = 0;  ///< turn rate [rad/s], counter-clockwise
};

}  // namespace rovernet
