// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "network/network.hpp"
#include "sim/fields.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

// Keys of robot commands, for code that reads commands from a text or from a program.

namespace rovernet {

/// std::tuple of the command types in a std::variant, except the type `Left`.
template <class Variant, class Left = void>
struct CommandList;
template <class... Commands, class Left>
struct CommandList<std::variant<Commands...>, Left> {
    using type =
        decltype(std::tuple_cat(std::conditional_t<std::is_same_v<Commands, Left>, std::tuple<>,
                                                   std::tuple<std::type_identity<Commands>>>{}...));
};
using AllCommands = CommandList<RobotCommand>::type;
using CommandsInPlace = CommandList<RobotCommand, SendCommand>::type;

/// Number of keys of a command, one for each field. A command without fields has its name as key,
/// with the value true.
template <class Command>
constexpr std::size_t number_of_keys() {
    std::size_t keys = 0;
    for_each_field<Command>([&](const auto&) { ++keys; });
    return std::max<std::size_t>(keys, 1);
}

/// Array of the keys of several command types, in the order of the template arguments.
template <class... Commands>
constexpr auto keys_of() {
    std::array<std::string_view, (number_of_keys<Commands>() + ...)> keys{};
    std::size_t i = 0;
    const auto add = [&]<class Command>(std::type_identity<Command>) {
        const std::size_t first = i;
        for_each_field<Command>([&](const auto& f) { keys[i++] = f.name; });
        if (i == first) keys[i++] = Command::name;
    };
    (add(std::type_identity<Commands>{}), ...);
    return keys;
}

/// Command whose fields have their default values. The defaults of a height and of a heading are
/// the current values of the robot.
template <class Command>
Command command_at(const Network& network, NodeId robot) {
    Command command{};
    for_each_field<Command>([&](const auto& f) {
        auto& value = command.*f.member;
        using Held = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::same_as<Held, Vec3>) value.z = network.position(robot).z;
        if constexpr (std::same_as<Held, Radians>) value = network.heading(robot);
    });
    return command;
}

}  // namespace rovernet
