// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/quantity.hpp"
#include "scenario/value.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// A size of something on air or in a file [bytes].
struct Bytes {
    std::uint32_t value = 0;
    friend bool operator==(Bytes, Bytes) = default;
};

// One overload per type that a key may have: reads the value, without its range.
// @throws InputError saying what was found and what was expected
void read_value(const Value& value, std::string_view key, bool& out);
void read_value(const Value& value, std::string_view key, int& out);
void read_value(const Value& value, std::string_view key, std::uint64_t& out);
void read_value(const Value& value, std::string_view key, double& out);
void read_value(const Value& value, std::string_view key, std::string& out);
void read_value(const Value& value, std::string_view key, Dbm& out);
void read_value(const Value& value, std::string_view key, Db& out);
void read_value(const Value& value, std::string_view key, Hertz& out);
void read_value(const Value& value, std::string_view key, Meters& out);
void read_value(const Value& value, std::string_view key, MetersPerSecond& out);
void read_value(const Value& value, std::string_view key, BitRate& out);
void read_value(const Value& value, std::string_view key, Radians& out);
void read_value(const Value& value, std::string_view key, RadiansPerSecond& out);
void read_value(const Value& value, std::string_view key, DbPerMeter& out);
void read_value(const Value& value, std::string_view key, Duration& out);
void read_value(const Value& value, std::string_view key, Bytes& out);
void read_value(const Value& value, std::string_view key, Vec3& out);

/// A text that is printed and names things: it has no control characters.
/// @throws InputError at the value
void check_printable(const Value& value, std::string_view key, std::string_view text);

/// Finds a word among an enumeration's.
std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices);

template <class E>
requires std::is_enum_v<E>
void read_value(const Value& value, std::string_view key, E& out) {
    const std::vector<std::string> choices(EnumNames<E>::values.begin(),
                                           EnumNames<E>::values.end());
    out = static_cast<E>(read_choice(value, key, choices));
}

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

template <class T>
void read_value(const Value& value, std::string_view key, std::optional<T>& out) {
    T present{};
    read_value(value, key, present);
    out = std::move(present);
}

// The reverse: the value as it stands in a file, with its unit.
Value to_value(bool v);
Value to_value(int v);
Value to_value(std::uint64_t v);
Value to_value(double v);
Value to_value(const std::string& v);
Value to_value(Dbm v);
Value to_value(Db v);
Value to_value(Hertz v);
Value to_value(Meters v);
Value to_value(MetersPerSecond v);
Value to_value(BitRate v);
Value to_value(Radians v);
Value to_value(RadiansPerSecond v);
Value to_value(DbPerMeter v);
Value to_value(Duration v);
Value to_value(Bytes v);
Value to_value(Vec3 v);
template <class E>
requires std::is_enum_v<E> Value to_value(E v) { return name_of(v); }
template <class T>
Value to_value(const std::vector<T>& v) {
    Array list;
    for (const auto& item : v) list.push_back(to_value(item));
    return list;
}

}  // namespace rovernet
