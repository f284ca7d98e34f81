// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "models/propagation/propagation.hpp"
#include "models/radio.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

// Robots, as added to a Network and as returned by it:
//
//     const NodeId a = network.add({.name = "A", .at = {2, 3}, .move = RandomWaypoint{...}});
//     network.robot(a).at;

namespace rovernet {

/// Robot to be added to a Network. All members except the position have defaults.
struct Robot {
    /// Name, unique; the robot's random draws depend on it. Empty: "r" and the robot's number.
    std::string name;
    /// Start position [m].
    Vec3 at;
    /// Radius of the body [m], for paths around walls.
    Meters radius{0.2};
    /// Radio; its antenna is at the antenna height above `at`.
    Radio radio = {};
    /// Propagation model of the robot's transmissions; empty: the Network's model.
    std::optional<Propagation> propagation = std::nullopt;
    /// Movement, which begins with the run, or now if the run has begun.
    Movement move = Fixed{};
    /// Heading at the start [rad].
    Radians heading{0};
    /// Speed limit of all movements but recorded ones [m/s], > 0.
    MetersPerSecond top_speed{std::numeric_limits<double>::infinity()};
    /// Turn rate [rad/s], within the range turn_rates: the robot turns in place before it moves,
    /// except for recorded movements; empty: the robot turns instantly.
    std::optional<RadiansPerSecond> turn_rate = std::nullopt;
    /// Role in the routing protocol, one of the protocol's RouterTraits::roles; empty: the
    /// protocol's default.
    std::string role = {};
};

/// Presence of a robot in the simulation. Robots of movement files can be absent before they appear
/// and after they disappear. All other robots are on or off.
enum class Presence {
    /// Present, with its radio on.
    on,
    /// Present, switched off.
    off,
    /// Not yet present, and off; the position is the place where the robot will appear.
    not_departed,
    /// No longer present, and off; the position is the robot's last position.
    left,
};

/// Names of the values of Presence in reports.
template <>
struct EnumNames<Presence> {
    static constexpr std::array<std::string_view, 4> values = {"on", "off", "not_departed", "left"};
};

/// Current state of a robot, for tables and pictures. Members that are references are valid until
/// the next robot is added; all other members are copies.
struct RobotState {
    std::string name;
    /// Current position [m].
    Vec3 at;
    /// Heading [rad], -pi ... pi, counter-clockwise from the x axis.
    Radians heading;
    /// Radius of the body [m].
    Meters radius;
    Presence presence;
    const Radio& radio;
    /// Propagation model of the robot's transmissions.
    const Propagation& propagation;
};

}  // namespace rovernet
