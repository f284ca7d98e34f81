// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/command_keys.hpp"
#include "python/arguments.hpp"
#include "python/session_object.hpp"

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

// Conversion of Python keyword arguments to robot commands. The function fields() of a command
// lists its keywords.

namespace rovernet::python {

/// Reads the value of a command's field from a Python object; ranges are checked later.
template <class Value>
void read_value(SessionObject& session, Value& value, std::string_view key,
                const py::handle& given) {
    if constexpr (requires { value.has_value(); }) {
        value.reset();
        if (!given.is_none()) read_value(session, value.emplace(), key, given);
    } else if constexpr (std::same_as<Value, NodeId>) {
        value = robot_named(session.network(), given.cast<std::string>());
    } else if constexpr (std::same_as<Value, Duration>) {
        value = from_seconds(given.cast<double>());
    } else if constexpr (std::same_as<Value, Vec3>) {
        const auto at = given.cast<std::vector<double>>();
        if (at.size() != 2 && at.size() != 3) {
            throw py::value_error(fmt::format(
                "{}: expected a place (x, y) or (x, y, z), got {} numbers", key, at.size()));
        }
        value = {at[0], at[1], at.size() == 3 ? at[2] : value.z};
    } else if constexpr (std::same_as<Value, std::string>) {
        value = given.cast<py::bytes>();
    } else if constexpr (std::unsigned_integral<Value> && !std::same_as<Value, bool>) {
        const auto number = given.cast<std::int64_t>();
        if (!std::in_range<Value>(number)) {
            throw py::value_error(fmt::format("{} must be from 0 to {}, got {}", key,
                                              std::numeric_limits<Value>::max(), number));
        }
        value = static_cast<Value>(number);
    } else if constexpr (std::same_as<Value, bool>) {
        value = given.cast<bool>();
    } else {
        value = Value{given.cast<double>()};
    }
}

/// What a command's field of this type may be in Python.
template <class Value>
constexpr std::string_view expected_for() {
    if constexpr (requires(Value value) { value.has_value(); }) {
        return expected_for<typename Value::value_type>();
    } else if constexpr (std::same_as<Value, NodeId>) {
        return "the name of a robot, such as \"A\"";
    } else if constexpr (std::same_as<Value, Duration>) {
        return "a number of seconds";
    } else if constexpr (std::same_as<Value, Vec3>) {
        return "a place (x, y) or (x, y, z) in metres";
    } else if constexpr (std::same_as<Value, std::string>) {
        return "bytes, such as b\"F\"";
    } else if constexpr (std::same_as<Value, bool>) {
        return "True or False";
    } else if constexpr (std::unsigned_integral<Value>) {
        return "a whole number";
    } else {
        return "a number";
    }
}

template <class Value>
void read_given(SessionObject& session, Value& value, std::string_view key,
                const py::handle& given) {
    try {
        read_value(session, value, key, given);
    } catch (const py::cast_error&) {
        throw py::type_error(
            fmt::format("{}: expected {}, got {}", key, expected_for<Value>(), shown(given)));
    }
}

/// Robot command of type `Command` from Python keyword arguments; none if a keyword is not one of
/// its keys.
template <class Command>
std::optional<RobotCommand> command_if(SessionObject& session, NodeId robot,
                                       const py::kwargs& given) {
    static constexpr auto keys = keys_of<Command>();
    for (const auto& [key, value] : given) {
        const auto name = key.template cast<std::string>();
        if (std::find(keys.begin(), keys.end(), name) == keys.end()) return std::nullopt;
    }
    auto command = command_at<Command>(session.network(), robot);
    for_each_field<Command>([&](const auto& f) {
        using Held = std::remove_cvref_t<decltype(command.*f.member)>;
        const py::str key(f.name.data(), f.name.size());
        if (given.contains(key)) {
            read_given(session, command.*f.member, f.name, given[key]);
        } else if (std::same_as<Held, Vec3> || std::same_as<Held, std::string>) {
            throw py::value_error(fmt::format("{} is missing", f.name));
        }
    });
    return command;
}

/// Robot command from Python keyword arguments. The keywords are the command's keys in the
/// lock-step protocol, and determine the type of the command.
template <class... Commands>
RobotCommand command_of(std::tuple<std::type_identity<Commands>...> /*commands*/,
                        SessionObject& session, NodeId robot, const py::kwargs& given) {
    std::optional<RobotCommand> found;
    const auto look = [&]<class Command>(std::type_identity<Command>) {
        if (!found && given.size() > 0) found = command_if<Command>(session, robot, given);
    };
    (look(std::type_identity<Commands>{}), ...);
    if (found) return std::move(*found);
    std::string known;
    const auto list = [&]<class Command>(std::type_identity<Command>) {
        known +=
            fmt::format("{}{}", known.empty() ? "" : "; or ", fmt::join(keys_of<Command>(), ", "));
    };
    (list(std::type_identity<Commands>{}), ...);
    std::vector<std::string> names;
    for (const auto& [key, value] : given) names.push_back(key.template cast<std::string>());
    throw py::value_error(
        fmt::format("command: found {}; expected {}",
                    names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", ")), known));
}

}  // namespace rovernet::python
