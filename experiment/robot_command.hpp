// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

// Commands from external programs to robots. A session executes them; an input log stores them.

namespace rovernet {

/// Command to drive ahead and turn, as Driven does, until the next command.
struct DriveCommand {
    MetersPerSecond speed{0};       ///< speed ahead [m/s], < 0: backwards
    RadiansPerSecond turn_rate{0};  ///< turn rate [rad/s], counter-clockwise
    /// The robot stops after this time; none: it does not stop.
    std::optional<Duration> timeout = {};
};

/// Command to drive to a point, around the walls, and to stop there.
struct GoalCommand {
    Vec3 to;                   ///< goal [m]
    MetersPerSecond speed{1};  ///< speed [m/s], > 0
};

/// Command to stand still.
struct StopCommand {};

/// Command that moves the robot to another position at once (teleport), at rest.
struct PlaceCommand {
    Vec3 at;          ///< new position [m]
    Radians heading;  ///< new heading [rad], counter-clockwise from the x axis
};

/// Command to send a message: to everyone by the routing protocol, or over one hop.
struct SendCommand {
    /// Destination over one hop: a robot, or `everyone` in range; none: to everyone, by the routing
    /// protocol.
    std::optional<NodeId> to = {};
    std::uint16_t port = 0;  ///< port: selects a program of the receiver
    std::string payload = {};
    std::optional<std::uint32_t> size = {};  ///< size on air [bytes]; none: length of the payload
};

// Ranges of the numbers in commands, checked by every interface that accepts commands.

inline constexpr Range drive_speeds{.low = -1000, .high = 1000, .text = "from -1000 to 1000 m/s"};
inline constexpr Range drive_turns{.low = -1000, .high = 1000, .text = "from -1000 to 1000 rad/s"};
inline constexpr Range goal_speeds{
    .low = 0, .high = 1000, .low_included = false, .text = "above 0 and up to 1000 m/s"};
inline constexpr Range goal_places{.low = -1e9, .high = 1e9, .text = "from -1e9 to 1e9 m"};
inline constexpr std::size_t longest_message = 65'535;  ///< largest payload of a message [bytes]
inline constexpr Duration shortest_step{
    1'000};  ///< shortest step [ns] that a lock-step controller may request

using RobotCommand =
    std::variant<DriveCommand, GoalCommand, StopCommand, PlaceCommand, SendCommand>;

/// Accepted command of a client. The scenario and all inputs together reproduce a run.
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
    Time time;    ///< delivery to the robot, 1 us after the frame was received
    NodeId at;    ///< robot that received the message
    NodeId from;  ///< origin of the message
    int hops;     ///< number of hops, from 1
    std::string payload;
    NodeId last_hop = {};           ///< transmitter of the frame that brought the message
    std::optional<Dbm> level = {};  ///< level of that frame at the receiver [dBm]; none if the
                                    ///< frame was on air before the first client joined
    std::uint16_t port = 0;         ///< port given by the sending client; 0: none
    bool is_for_everyone = true;    ///< false: a unicast to `at`
    friend bool operator==(const HeardMessage&, const HeardMessage&) = default;
};

/// Velocity of a robot in its own frame, as its odometry would measure it.
struct Twist {
    double speed = 0;      ///< speed ahead [m/s], < 0: backwards
    double turn_rate = 0;  ///< turn rate [rad/s], counter-clockwise
};

}  // namespace rovernet
