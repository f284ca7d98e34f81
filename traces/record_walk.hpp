// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

// Functions that visit the fields of a record of any kind, or its values of one type.

namespace rovernet {

/// Calls visit(time, index) for each time of a record: for the time of each reception if the record
/// has receptions, otherwise once, with index 0.
template <class R, class Visit>
void for_each_time(const R& record, const Visit& visit) {
    if constexpr (requires { record.receptions; }) {
        for (std::size_t i = 0; i < record.receptions.size(); ++i) {
            visit(record.receptions[i].time, i);
        }
    } else if constexpr (requires { record.reception; }) {
        visit(record.reception.time, std::size_t{0});
    } else {
        visit(record.time, std::size_t{0});
    }
}

/// Whether a type is a std::optional; is_span: whether a type is a std::span.
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_span = false;
template <class T>
inline constexpr bool is_span<std::span<T>> = true;

/// Type whose values are written as one byte in a recorded trace.
template <class T>
concept OneByte = std::is_enum_v<T> || std::same_as<T, bool> || std::same_as<T, std::uint8_t>;
/// Quantity with a unit, such as Meters or Dbm.
template <class T>
concept Quantitative = requires(T quantity) {
    { quantity.value } -> std::same_as<double&>;
};

/// Calls visit(field) for each field of a record, or of a part of a record, that a recorded trace
/// stores in the record's bytes: all recorded fields except the time of the record.
template <class Part, class Visit>
constexpr void for_each_recorded(const Visit& visit) {
    for_each_field_of<Part>([&]<class Field>(const Field& f) {
        if constexpr ((Field::use & not_recorded) == 0) {
            if (!is_time_of_record(f)) visit(f);
        }
    });
}

/// Whether the type `Whole` is `T`, or may contain values of type `T`; for pruning a search at
/// compile time.
template <class T, class Whole>
consteval bool may_have() {
    if constexpr (std::same_as<T, Whole>) {
        return true;
    } else if constexpr (is_optional<Whole>) {
        return may_have<T, typename Whole::value_type>();
    } else if constexpr (is_span<Whole>) {
        return may_have<T, typename Whole::value_type>();
    } else if constexpr (DescribedPart<Whole>) {
        bool found = false;
        for_each_field_of<Whole>(
            [&]<class S, class Member, FieldUse use>(const RecordField<S, Member, use>&) {
                found = found || may_have<T, Member>();
            });
        return found;
    } else {
        return false;
    }
}

/// Calls visit(value) for each value of type `T` in a record or a part of a record, in the order of
/// the fields. The MessageId of a control frame, which has no message, is left out.
///
///     for_each_in<NodeId>(transmitted, [](NodeId robot) { ... });
template <class T, class Whole, class Visit>
constexpr void for_each_in(Whole& whole, const Visit& visit) {
    using Plain = std::remove_const_t<Whole>;
    if constexpr (std::same_as<T, Plain>) {
        visit(whole);
    } else if constexpr (!may_have<T, Plain>()) {
        return;
    } else if constexpr (is_optional<Plain>) {
        if (whole) for_each_in<T>(*whole, visit);
    } else if constexpr (is_span<Plain>) {
        for (auto& each : whole) for_each_in<T>(each, visit);
    } else {
        if constexpr (std::same_as<T, MessageId> && std::same_as<Plain, AirFrame>) {
            if (!has_message(whole)) return;
        }
        for_each_field_of<Plain>([&](const auto& f) { for_each_in<T>(whole.*f.member, visit); });
    }
}

}  // namespace rovernet
