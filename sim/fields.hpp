// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace rovernet {

/// The values a number may take, and the words that say so in an error.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_included = true;
    std::string_view text = "finite";

    /// Whether `v` is finite and lies in the range. NaN does not.
    constexpr bool contains(double v) const {
        constexpr double largest = std::numeric_limits<double>::max();
        return v >= -largest && v <= largest && (low_included ? v >= low : v > low) && v <= high;
    }
};

/// A parameter without a default: not a number until the user gives one.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

inline constexpr Range any{};
inline constexpr Range positive{.low = 0, .low_included = false, .text = "> 0"};
inline constexpr Range non_negative{.low = 0, .text = ">= 0"};

/// One public parameter of a struct: its name in files and on the command line, where it is, what
/// it may be and what it means. A struct lists its parameters once, in `fields()`; parsing, checks,
/// printing and the documentation follow from that list.
template <class Struct, class T>
struct Field {
    std::string_view name;
    T Struct::*member;
    Range range;
    std::string_view meaning;
};

template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member, Range range,
                                 std::string_view meaning) {
    return {name, member, range, meaning};
}

template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member,
                                 std::string_view meaning) {
    return {name, member, any, meaning};
}

template <class... Fields>
constexpr std::tuple<Fields...> describe(Fields... fields) {
    return {fields...};
}

template <class T>
concept Described = requires {
    T::fields();
};

/// Calls `visit(field)` for each parameter of `T`, in the order of its list.
template <Described T, class Visitor>
constexpr void for_each_field(Visitor&& visit) {
    std::apply([&](const auto&... each) { (visit(each), ...); }, T::fields());
}

/// The number inside a parameter, for the range check; nothing for what is not a number.
template <class T>
constexpr std::optional<double> number_in(const T& v) {
    if constexpr (requires { v.has_value(); }) {
        return v ? number_in(*v) : std::nullopt;
    } else if constexpr (std::same_as<T, Duration>) {
        return seconds(v);
    } else if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) {
        return static_cast<double>(v);
    } else if constexpr (requires { static_cast<double>(v.value); }) {
        return static_cast<double>(v.value);
    } else {
        return std::nullopt;
    }
}

/// The words that stand for an enumeration's values 0, 1, 2 ... in files; specialise `values`.
template <class E>
struct EnumNames;

template <class E>
constexpr std::string_view name_of(E e) {
    return EnumNames<E>::values[static_cast<std::size_t>(e)];
}

/// Says that parameter `name` of `owner` is out of its range.
[[noreturn]] void throw_out_of_range(std::string_view owner, std::string_view name,
                                     std::string_view range, double got);

/// Checks every numeric parameter against its range. The caller's fault if one is outside:
/// @throws std::invalid_argument naming the parameter, its range and the value
template <Described T>
void check_fields(const T& value, std::string_view owner) {
    for_each_field<T>([&](const auto& f) {
        const auto number = number_in(value.*f.member);
        if (number && !f.range.contains(*number)) {
            throw_out_of_range(owner, f.name, f.range.text, *number);
        }
    });
}

}  // namespace rovernet
