// SPDX-License-Identifier: MIT
#pragma once

#include "sim/parameter.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

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
// the sweep of a study follow from this list.

namespace rovernet {

/// Value of a parameter without a default: NaN until the user sets it. check_fields() reports such
/// a value as an error.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// Description of one public parameter of a struct, as listed by fields().
template <class Struct, class T>
struct Field {
    /// Key in files and on the command line, in snake_case.
    std::string_view name;
    /// Member with the value: a number, a quantity, a Duration, an enumeration with EnumNames, a
    /// bool, a string, or a std::optional of one of these.
    T Struct::*member;
    /// Range of the number; `any` if the value is not a number.
    Range range;
    /// Meaning, for help and documentation: a phrase without a full stop.
    std::string_view meaning;
    /// Way in which a fit to measured losses (calibration) determines the parameter.
    Fit fit = {};

    /// Copy of this description with Fit::way as named by the function, and Fit::base = `base`.
    ///
    ///   field("exponent", &LogDistance::exponent, positive, "path loss exponent").linear(2)
    constexpr Field linear(double base) const { return with({Fit::Way::linear, base}); }
    constexpr Field constant(double base) const { return with({Fit::Way::constant, base}); }
    constexpr Field searched(double base) const { return with({Fit::Way::searched, base}); }
    constexpr Field by_decisions() const { return with({Fit::Way::decisions}); }
    constexpr Field spread() const { return with({Fit::Way::spread}); }

  private:
    constexpr Field with(Fit way) const {
        Field out = *this;
        out.fit = way;
        return out;
    }
};

/// Description of a parameter that is a number within a range.
template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member, Range range,
                                 std::string_view meaning) {
    return {name, member, range, meaning, {}};
}

/// Description of a parameter that is any finite number, or not a number.
template <class Struct, class T>
constexpr Field<Struct, T> field(std::string_view name, T Struct::*member,
                                 std::string_view meaning) {
    return {name, member, any, meaning, {}};
}

/// List of the fields of a struct, in order. A std::tuple instead would take several times as long
/// to compile.
template <class Numbers, class... Fields>
struct FieldList;
template <std::size_t number, class Field>
struct FieldAt {
    Field field;
};
template <std::size_t... number, class... Fields>
struct FieldList<std::index_sequence<number...>, Fields...> : FieldAt<number, Fields>... {
    template <class Visitor>
    constexpr void for_each([[maybe_unused]] Visitor&& visit) const {
        (visit(FieldAt<number, Fields>::field), ...);
    }
};

/// List of the descriptions of parameters, for a struct's fields().
template <class... Fields>
constexpr FieldList<std::index_sequence_for<Fields...>, Fields...> describe(Fields... fields) {
    return {{fields}...};
}

/// Struct that lists its parameters by fields().
template <class T>
concept Described = requires {
    T::fields();
};

/// Calls visit(field) for each parameter of `T`, in the order of fields(). The fields have
/// different types, so `visit` is generic.
///
///   for_each_field<Friis>([&](const auto& f) { print(f.name, f.meaning); });
template <Described T, class Visitor>
constexpr void for_each_field(Visitor&& visit) {
    T::fields().for_each(visit);
}

/// Number in a parameter, for the range check and for printing: a Duration in [s], a quantity in
/// its unit. Empty for a value that is not a number, and for an optional without a value.
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

/// Sets the number in a parameter, in the unit in which number_in() returns it. An optional without
/// a value gets a value. A parameter that is not a number is left unchanged.
template <class T>
constexpr void set_number(T& v, double number) {
    if constexpr (requires { v.has_value(); }) {
        set_number(v.emplace(), number);
    } else if constexpr (std::is_arithmetic_v<T>) {
        v = static_cast<T>(number);
    } else if constexpr (requires { static_cast<double>(v.value); }) {
        v.value = static_cast<decltype(v.value)>(number);
    }
}

/// Words in files for the values 0, 1, 2 ... of an enumeration. An enumeration that occurs in files
/// specialises EnumNames:
///
///   template <>
///   struct EnumNames<Duplicates> {
///       static constexpr std::array<std::string_view, 2> values = {"suppress", "forward"};
///   };
template <class E>
struct EnumNames;

/// Word in files for a value of an enumeration; the value must be listed in EnumNames.
template <class E>
constexpr std::string_view name_of(E e) {
    return EnumNames<E>::values[static_cast<std::size_t>(e)];
}

/// Throws the error for a parameter that is out of its range or not set.
/// @param owner  name of the model that has the parameter
/// @param name   key of the parameter
/// @param range  Range::text
/// @param got    value that was given; NaN if no value was given
/// @throws std::invalid_argument "OWNER: NAME must be RANGE, got VALUE"
[[noreturn]] void throw_out_of_range(std::string_view owner, std::string_view name,
                                     std::string_view range, double got);

/// Checks every numeric parameter of a struct against its range. Models call check_fields() when
/// they are constructed or first used; the scenario reader checks the same ranges earlier and
/// reports the place in the file.
/// @param value  struct with fields()
/// @param owner  name of the struct in the error
/// @throws std::invalid_argument with the first parameter that is out of range, its range and its
///         value
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
