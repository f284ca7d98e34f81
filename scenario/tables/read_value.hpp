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

// Values of a document as C++ values, and back. There is a read_value() and a to_value() for each
// type that a key may have; a described struct is read and written with them, field by field.

namespace rovernet {

/// Size of a message or a header [bytes], at most 1 MB in a file.
struct Bytes {
    std::uint32_t value = 0;
    friend bool operator==(Bytes, Bytes) = default;
};

/// Reads the value into `out`, of whatever type that is, without looking at the range of its field.
/// Numbers with a dimension need their unit, see read_quantity(); a Vec3 is a list of two or three
/// lengths.
/// @param key  for the error
/// @throws InputError at the value, saying what was found and what was expected; `out` may have
/// changed
void read_value(const Value& value, std::string_view key, bool& out);
/// Whole numbers: of 32 bits, and from 0 to 2^63 - 1.
void read_value(const Value& value, std::string_view key, int& out);
void read_value(const Value& value, std::string_view key, std::uint64_t& out);
/// Number without a unit, at most 1e9: factors and exponents, whose products stay finite.
void read_value(const Value& value, std::string_view key, double& out);
/// Text in quotes, with any characters.
void read_value(const Value& value, std::string_view key, std::string& out);
/// Quantities with their units; a power in watts becomes a level.
void read_value(const Value& value, std::string_view key, Dbm& out);
void read_value(const Value& value, std::string_view key, Db& out);
void read_value(const Value& value, std::string_view key, Hertz& out);
void read_value(const Value& value, std::string_view key, Meters& out);
void read_value(const Value& value, std::string_view key, MetersPerSecond& out);
/// Bit rate; one between 0 and 1 bit/s is refused.
void read_value(const Value& value, std::string_view key, BitRate& out);
void read_value(const Value& value, std::string_view key, Radians& out);
void read_value(const Value& value, std::string_view key, RadiansPerSecond& out);
void read_value(const Value& value, std::string_view key, DbPerMeter& out);
/// Length of time, rounded to nanoseconds.
void read_value(const Value& value, std::string_view key, Duration& out);
/// Whole number of bytes from 0 B to 1 MB.
void read_value(const Value& value, std::string_view key, Bytes& out);
/// Position: a list of two or three lengths; z is 0 if it is not given.
void read_value(const Value& value, std::string_view key, Vec3& out);
/// Point of an antenna's pattern: a list of two numbers, degrees and dB.
void read_value(const Value& value, std::string_view key, PatternPoint& out);

/// Checks that a text that is printed and names things has no control characters.
/// @throws InputError at the value
void check_printable(const Value& value, std::string_view key, std::string_view text);

/// Finds a word among an enumeration's.
/// @return index into `choices`
/// @throws InputError for another word, naming all choices and the nearest
std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices);

/// Reads an enumeration by the words of its EnumNames.
template <class E>
requires std::is_enum_v<E>
void read_value(const Value& value, std::string_view key, E& out) {
    const std::vector<std::string> choices(EnumNames<E>::values.begin(),
                                           EnumNames<E>::values.end());
    out = static_cast<E>(read_choice(value, key, choices));
}

/// Reads a list, item by item.
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

/// Reads a value that may be missing in the file, and is there.
template <class T>
void read_value(const Value& value, std::string_view key, std::optional<T>& out) {
    T present{};
    read_value(value, key, present);
    out = std::move(present);
}

/// Value as it stands in a file, with its unit: read_value() reads it back as the same.
Value to_value(bool v);
Value to_value(int v);
Value to_value(std::uint64_t v);
/// Numbers and texts as they are.
Value to_value(double v);
Value to_value(const std::string& v);
/// Quantities, as texts with the unit that makes the number whole, if one does.
Value to_value(Dbm v);
Value to_value(Db v);
Value to_value(Hertz v);
Value to_value(Meters v);
Value to_value(MetersPerSecond v);
Value to_value(BitRate v);
Value to_value(Radians v);
Value to_value(RadiansPerSecond v);
Value to_value(DbPerMeter v);
/// Length of time in the largest of s, ms, us and ns that makes it whole.
Value to_value(Duration v);
Value to_value(Bytes v);
/// Position as a list of lengths, z left out if it is 0.
Value to_value(Vec3 v);
Value to_value(const PatternPoint& v);
/// Word of an enumeration. List, item by item.
template <class E>
requires std::is_enum_v<E> Value to_value(E v) { return name_of(v); }
template <class T>
Value to_value(const std::vector<T>& v) {
    Array list;
    for (const auto& item : v) list.push_back(to_value(item));
    return list;
}

}  // namespace rovernet
