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

// Descriptions of parameters. A struct with parameters lists them once:
//
//     struct Disc {
//         static constexpr std::string_view name = "disc";
//         Meters range{unset};
//
//         static constexpr auto fields() {
//             return describe(field("range", &Disc::range, non_negative, "hears within it"));
//         }
//     };
//
// The reader of scenario files, range checks, --set, the printed scenario, `rovernet models` and
// the sweep of a study follow from that list.

namespace rovernet {

/// Range of a number, and the words for it in an error ("must be > 0"). The limits are in the unit
/// in which number_in() gives the parameter.
struct Range {
    /// Lower limit.
    double low = -std::numeric_limits<double>::infinity();
    /// Upper limit, included.
    double high = std::numeric_limits<double>::infinity();
    /// Whether the lower limit is included.
    bool low_included = true;
    /// Words that follow "must be" in an error.
    std::string_view text = "finite";

    /// Whether `v` is finite and lies in the range. NaN does not.
    constexpr bool contains(double v) const {
        constexpr double largest = std::numeric_limits<double>::max();
        return v >= -largest && v <= largest && (low_included ? v >= low : v > low) && v <= high;
    }
};

/// Value of a parameter that has no default: not a number, until the user gives one. check_fields()
/// refuses it.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// The usual ranges: any finite number; finite and > 0; finite and >= 0.
inline constexpr Range any{};
inline constexpr Range positive{.low = 0, .low_included = false, .text = "> 0"};
inline constexpr Range non_negative{.low = 0, .text = ">= 0"};

/// One public parameter of a struct, as fields() lists it.
template <class Struct, class T>
struct Field {
    /// Key in files and on the command line, in snake_case.
    std::string_view name;
    /// Member that holds the value: a number, a quantity, a Duration, an enumeration with
    /// EnumNames, a bool, a string, or a std::optional of one.
    T Struct::*member;
    /// Range of the number in it; `any` where it is none.
    Range range;
    /// Meaning, for help and documentation: a phrase without a full stop.
    std::string_view meaning;
};

/// Field with a range.
template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member, Range range,
                                 std::string_view meaning) {
    return {name, member, range, meaning};
}

/// Field of any finite number, or of what is no number.
template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member,
                                 std::string_view meaning) {
    return {name, member, any, meaning};
}

/// List of fields, for a struct's fields().
template <class... Fields>
constexpr std::tuple<Fields...> describe(Fields... fields) {
    return {fields...};
}

/// Struct that lists its parameters.
template <class T>
concept Described = requires {
    T::fields();
};

/// Calls visit(field) for each parameter of `T`, in the order of its list. The fields have
/// different types: `visit` is generic.
///
///   for_each_field<Friis>([&](const auto& f) { print(f.name, f.meaning); });
template <Described T, class Visitor>
constexpr void for_each_field(Visitor&& visit) {
    std::apply([&](const auto&... each) { (visit(each), ...); }, T::fields());
}

/// Number inside a parameter, for the range check and for printing: [s] of a Duration, the value of
/// a quantity in its own unit; nothing for what is no number, and for an optional without a value.
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

/// Words that stand for the values 0, 1, 2 ... of an enumeration in files. An enumeration that a
/// file may name specialises it:
///
///   template <>
///   struct EnumNames<Duplicates> {
///       static constexpr std::array<std::string_view, 2> values = {"suppress", "forward"};
///   };
template <class E>
struct EnumNames;

/// Word for a value of an enumeration, which must be one of those listed.
template <class E>
constexpr std::string_view name_of(E e) {
    return EnumNames<E>::values[static_cast<std::size_t>(e)];
}

/// Throws the error for a parameter out of its range, or for one that is unset.
/// @param owner  whose parameter it is: a model's name
/// @param name   the parameter's key
/// @param range  Range::text
/// @param got    the value that was given; not a number: none was
/// @throws std::invalid_argument "OWNER: NAME must be RANGE, got VALUE"
[[noreturn]] void throw_out_of_range(std::string_view owner, std::string_view name,
                                     std::string_view range, double got);

/// Checks every numeric parameter of a struct against its range. Models do it when they are made or
/// used first; scenario files have the same ranges checked earlier, with the place in the file.
/// @param value  struct whose fields() are looked at
/// @param owner  name for the error
/// @throws std::invalid_argument naming the first parameter that is outside, its range and the
/// value
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
