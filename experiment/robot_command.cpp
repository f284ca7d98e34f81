// SPDX-License-Identifier: MIT
#include "experiment/robot_command.hpp"

#include <fmt/format.h>

#include <concepts>
#include <stdexcept>

namespace rovernet {
namespace {

/// Checks the value of a field.
template <class Field, class Value>
void check(const Field& field, const Value& value, std::string_view robot) {
    if constexpr (std::same_as<Value, Vec3>) {
        for (const double number : {value.x, value.y, value.z}) check(field, number, robot);
    } else if constexpr (std::same_as<Value, std::string>) {
        if (field.range.contains(static_cast<double>(value.size()))) return;
        throw std::invalid_argument(fmt::format("a {} of robot {} has {} bytes; expected {}",
                                                field.meaning, robot, value.size(),
                                                field.range.text));
    } else if (const auto number = number_in(value); number && !field.range.contains(*number)) {
        const bool is_time = std::same_as<Value, std::optional<Duration>>;
        throw std::invalid_argument(fmt::format("{} of robot {} must be {}{}", field.meaning, robot,
                                                field.range.text,
                                                is_time ? "" : fmt::format(", got {}", *number)));
    }
}

}  // namespace

std::string_view name_of(const RobotCommand& command) {
    return std::visit([](const auto& each) { return each.name; }, command);
}

void check(const RobotCommand& command, std::string_view robot) {
    const auto check_all = [&]<class Command>(const Command& each) {
        for_each_field<Command>([&](const auto& f) { check(f, each.*f.member, robot); });
    };
    std::visit(check_all, command);
}

}  // namespace rovernet
