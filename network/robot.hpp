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

// Robots, as they are given to a Network and as they are asked for:
//
//     const NodeId a = network.add({.name = "A", .at = {2, 3}, .move = RandomWaypoint{...}});
//     network.robot(a).at;

namespace rovernet {

/// Robot as it joins a Network. All members have defaults but the place.
struct Robot {
    /// Name, unique; its random draws depend on it. Empty: "r" and its number.
    std::string name;
    /// Place where it starts [m].
    Vec3 at;
    /// Radius of its body [m], for ways around walls.
    Meters radius{0.2};
    /// Radio, whose antenna is at its height above `at`.
    Radio radio = {};
    /// Model of what it transmits; none: the Network's.
    std::optional<Propagation> propagation = std::nullopt;
    /// Movement, which begins with the run, or now if that has begun.
    Movement move = Fixed{};
    /// Heading at the start [rad].
    Radians heading{0};
    /// Speed that no movement exceeds [m/s], > 0.
    MetersPerSecond top_speed{std::numeric_limits<double>::infinity()};
    /// Turn rate [rad/s], within turn_rates: it turns in place before it moves off; none: it turns
    /// at once.
    std::optional<RadiansPerSecond> turn_rate = std::nullopt;
};

/// Presence of a robot: whether it takes part in what happens. Robots of movement files come and
/// go; others are on or off.
enum class Presence {
    /// It is there, its radio is on.
    on,
    /// It is there, switched off.
    off,
    /// It is not there yet, and off: where it is means where it will appear.
    not_departed,
    /// It is not there any more, and off: where it is means where it was last.
    left,
};

template <>
struct EnumNames<Presence> {
    static constexpr std::array<std::string_view, 4> values = {"on", "off", "not_departed", "left"};
};

/// State of a robot now, for tables and pictures. The references hold until the next robot is
/// added; the rest is a copy.
struct RobotState {
    std::string name;
    /// Position [m].
    Vec3 at;
    /// Heading [rad], -pi ... pi, counter-clockwise from the x axis.
    Radians heading;
    /// Radius of its body [m].
    Meters radius;
    Presence presence;
    const Radio& radio;
    /// Model that rules what it transmits.
    const Propagation& propagation;
};

}  // namespace rovernet
