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

// Commands that a program outside gives to its robots, as values: a session carries them out, a log
// of inputs keeps them.

namespace rovernet {

/// Command to drive ahead and turn, as Driven does, until the next command.
struct DriveCommand {
    MetersPerSecond speed{0};              ///< [m/s], < 0: backwards
    RadiansPerSecond turn_rate{0};         ///< [rad/s], counter-clockwise
    std::optional<Duration> timeout = {};  ///< the robot stands still after that; none: never
};

/// Command to go to a place, around the walls, and to rest there.
struct GoalCommand {
    Vec3 to;                   ///< [m]
    MetersPerSecond speed{1};  ///< [m/s], > 0
};

/// Command to stand still.
struct StopCommand {};

/// Command that puts the robot somewhere else at once, at rest.
struct PlaceCommand {
    Vec3 at;          ///< [m]
    Radians heading;  ///< [rad], counter-clockwise from the x axis
};

/// Command to send a message: to everyone by the routing protocol, or over one hop.
struct SendCommand {
    /// Over one hop to a robot, or to `everyone` that hears it; none: to everyone, by routing.
    std::optional<NodeId> to = {};
    std::uint16_t port = 0;  ///< which program of the receiver it is for
    std::string payload = {};
    std::optional<std::uint32_t> size = {};  ///< on air [bytes]; the payload's length if not given
};

// Ranges of the numbers in commands, for the doors through which they come.

inline constexpr Range drive_speeds{.low = -1000, .high = 1000, .text = "from -1000 to 1000 m/s"};
inline constexpr Range drive_turns{.low = -1000, .high = 1000, .text = "from -1000 to 1000 rad/s"};
inline constexpr Range goal_speeds{
    .low = 0, .high = 1000, .low_included = false, .text = "above 0 and up to 1000 m/s"};
inline constexpr Range goal_places{.low = -1e9, .high = 1e9, .text = "from -1e9 to 1e9 m"};
inline constexpr std::size_t longest_message = 65'535;  ///< [bytes]
inline constexpr Duration shortest_step{1'000};         ///< [ns] of a program that asks for steps

using RobotCommand =
    std::variant<DriveCommand, GoalCommand, StopCommand, PlaceCommand, SendCommand>;

/// Command as it was accepted: what happens after that follows from it and the scenario.
struct Input {
    Time time;
    NodeId robot;
    std::string client;        ///< name of the client that gave it
    std::uint64_t number = 0;  ///< client's own number of it
    RobotCommand command;
};

}  // namespace rovernet
