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

namespace rovernet {

/// A robot as it joins a Network.
struct Robot {
    std::string name;    ///< unique; its random draws depend on it. Empty: "r" and its number
    Vec3 at;             ///< [m] where it starts
    Meters radius{0.2};  ///< of its body, for ways around walls
    Radio radio = {};
    std::optional<Propagation> propagation = std::nullopt;  ///< the Network's default if not given
    Movement move = Fixed{};
    Radians heading{0};                                                  ///< at the start
    MetersPerSecond top_speed{std::numeric_limits<double>::infinity()};  ///< > 0
    /// Within turn_rates: it turns in place before it moves off; none: it turns at once.
    std::optional<RadiansPerSecond> turn_rate = std::nullopt;
};

/// Whether a robot takes part in what happens.
enum class Presence {
    on,            ///< it is there, its radio is on
    off,           ///< it is there, switched off
    not_departed,  ///< it is not there yet, and off: where it is means where it will appear
    left,          ///< it is not there any more, and off: where it is means where it was last
};

template <>
struct EnumNames<Presence> {
    static constexpr std::array<std::string_view, 4> values = {"on", "off", "not_departed", "left"};
};

/// A robot as it is now. The references hold until the next robot is added.
struct RobotState {
    std::string name;
    Vec3 at;          ///< [m]
    Radians heading;  ///< -pi ... pi, counter-clockwise from the x axis
    Meters radius;    ///< of its body
    Presence presence;
    const Radio& radio;
    const Propagation& propagation;  ///< the model that rules what it transmits
};

}  // namespace rovernet
