// SPDX-License-Identifier: MIT
#pragma once

#include "models/antenna.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/document/value.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Conversion between values of a document and C++ values. Each type that a key can have has an
// overload of read_value() and of to_value(). Described structs are converted field by field.

namespace rovernet {

/// Reads a value into `out` by the type of `out`, without checking the range of the field. Numbers
/// with a dimension need their unit, see read_quantity(); a Vec3 is a list of two or three lengths.
/// @param key  name of the value's key, for the error message
/// @throws InputError at the value; the message names the found and the expected value. `out` may
/// have changed
void read_value(const Value& value, std::string_view key, bool& out);
/// Reads a whole number: of 32 bits for int, from 0 to 2^63 - 1 for std::uint64_t.
void read_value(const Value& value, std::string_view key, int& out);
void read_value(const Value& value, std::string_view key, std::uint64_t& out);
/// Reads a number without a unit, such as a factor or an exponent, from -1e9 to 1e9. The limit
/// keeps products finite.
void read_value(const Value& value, std::string_view key, double& out);
/// Reads a text in quotes, with any characters.
void read_value(const Value& value, std::string_view key, std::string& out);
/// Reads a quantity with its unit; a power in watts is converted to dBm.
template <IsQuantity Q>
void read_value(const Value& value, std::string_view key, Q& out) {
    out = {read_quantity(value, key, dimension_of(out))};
}
/// Reads a bit rate; a rate between 0 and 1 bit/s is an error.
void read_value(const Value& value, std::string_view key, BitRate& out);
/// Reads a duration, rounded to nanoseconds.
void read_value(const Value& value, std::string_view key, Duration& out);
/// Reads a whole number of bytes from 0 B to 1 MB.
void read_value(const Value& value, std::string_view key, Bytes& out);
/// Reads a position: a list [x, y] or [x, y, z] of lengths; a missing z is 0.
void read_value(const Value& value, std::string_view key, Vec3& out);
/// Reads a point of an antenna pattern: a list of two numbers, degrees and dB.
void read_value(const Value& value, std::string_view key, PatternPoint& out);

/// Checks that a text used as a name has no control characters.
/// @throws InputError at the value
void check_printable(const Value& value, std::string_view key, std::string_view text);

/// Reads a word that must be one of `choices`, the names of an enumeration.
/// @return index of the word in `choices`
/// @throws InputError for an unknown word; the message lists all choices and suggests the most
/// similar one
std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices);

/// Reads an enumeration by the names in its EnumNames.
template <class E>
requires std::is_enum_v<E>
void read_value(const Value& value, std::string_view key, E& out) {
    const std::vector<std::string> choices(EnumNames<E>::values.begin(),
                                           EnumNames<E>::values.end());
    out = static_cast<E>(read_choice(value, key, choices));
}

/// Reads a list into `out`, item by item.
template <class T>
void read_value(const Value& value, std::string_view key, std::vector<T>& out) {
    const Array* list = value.array();
    if (!list) {
        throw InputError(value.where, std::string(key) + ": found " + value.description() +
                                          "; expected a list in [ ]");
    }
    out.clear();
    for (const auto& item : *list) {
        T element{};
        read_value(item, key, element);
        out.push_back(std::move(element));
    }
}

/// Reads the value of an optional key; called only if the file gives the key.
template <class T>
void read_value(const Value& value, std::string_view key, std::optional<T>& out) {
    T present{};
    read_value(value, key, present);
    out = std::move(present);
}

/// Converts a C++ value to a value of a scenario file, with its unit if it has one. read_value()
/// converts the result back to the same C++ value.
Value to_value(bool v);
Value to_value(int v);
Value to_value(std::uint64_t v);
/// Converts a number without a unit, or a text, to a value of a scenario file.
Value to_value(double v);
Value to_value(const std::string& v);
/// Text of a quantity with its unit, if possible in a unit in which the number is whole.
template <IsQuantity Q>
Value to_value(Q v) {
    return quantity_text(v.value, dimension_of(v));
}
/// Text of a duration, in the largest of the units s, ms, us and ns in which the number is whole.
Value to_value(Duration v);
Value to_value(Bytes v);
/// List of lengths for a position, [x, y, z]; z is omitted if it is 0.
Value to_value(Vec3 v);
Value to_value(const PatternPoint& v);
/// Name of an enumerator, as a text.
template <class E>
requires std::is_enum_v<E> Value to_value(E v) { return name_of(v); }
template <class T>
Value to_value(const std::vector<T>& v) {
    Array list;
    for (const auto& item : v) list.push_back(to_value(item));
    return list;
}

}  // namespace rovernet
