// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/fields.hpp"
#include "sim/leg.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

// Descriptions of records. A record lists its fields once, by fields(); recorded traces, their
// text, tables of rows and fingerprints visit them in that order. A field is a number, a quantity,
// a bool, Time, Duration, NodeId, MessageId, Vec3, an optional NodeId or unsigned number, a Fate or
// a DropReason, or a described struct, whose fields are then visited in its place.
//
//     struct Arrived {
//         Time time;
//         NodeId node;
//         static constexpr std::string_view name = "Arrived";
//         static constexpr auto fields() {
//             return describe(field("time", &Arrived::time), field("node", &Arrived::node));
//         }
//     };
//
// Most records begin with `time`, the time of the record.

namespace rovernet {

/// Special treatment of a record's field, such as not_hashed: bits, combined by |; 0: none.
using FieldUse = unsigned;
/// Field that fingerprints do not contain.
inline constexpr FieldUse not_hashed = 1;
/// Field that recorded traces do not contain, so that replays do not compare it.
inline constexpr FieldUse not_recorded = 2;
/// Field that tables of rows do not contain.
inline constexpr FieldUse not_in_rows = 4;
/// Field that fingerprints, recorded traces and tables of rows do not contain.
inline constexpr FieldUse not_visited = not_in_rows | not_hashed | not_recorded;
/// Field of type NodeId whose value may be `everyone`.
inline constexpr FieldUse or_everyone = 8;
/// Field of type MessageId: fingerprints contain the message's origin and size in addition to its
/// uid.
inline constexpr FieldUse with_origin = 16;
/// Field that recorded traces contain from format `format` on. If a trace is older, the field has
/// its default value.
constexpr FieldUse since(unsigned format) { return format << 8; }
/// First format of recorded traces that contains a field with this use, see since().
constexpr unsigned first_format(FieldUse use) { return use >> 8; }

/// Description of one field of a record.
template <class Struct, class T, FieldUse its_use>
struct RecordField {
    static constexpr FieldUse use = its_use;
    /// Name of the field in layouts of recorded traces, and of its column in tables.
    std::string_view name;
    T Struct::*member;
};

/// Description of a field, with its use: field<not_hashed>("reachable", &Sent::reachable).
template <FieldUse use = 0, class Struct, class T>
constexpr RecordField<Struct, T, use> field(std::string_view name, T Struct::*member) {
    return {name, member};
}

/// Whether the field is the member `time` of its record, or of a reception.
template <class Struct, class T, FieldUse use>
constexpr bool is_time_of_record(const RecordField<Struct, T, use>& field) {
    if constexpr (std::is_same_v<T, Time> && requires { &Struct::time; }) {
        return field.member == &Struct::time;
    }
    return false;
}

/// Whether the frame transmits a message, whose id it then contains; false for a control frame.
constexpr bool has_message(const AirFrame& air) { return !air.control; }

/// Descriptions of structs that are parts of records.
template <class Part>
struct FieldsOf;
template <Described Part>
struct FieldsOf<Part> {
    static constexpr auto fields() { return Part::fields(); }
};
template <>
struct FieldsOf<Frame> {
    static constexpr auto fields() {
        return describe(field("message", &Frame::message), field("sender", &Frame::sender),
                        field<not_visited>("path", &Frame::path), field("ttl", &Frame::ttl),
                        field("hops", &Frame::hops),
                        field<or_everyone | not_hashed>("next_hop", &Frame::next_hop),
                        field<not_hashed | not_in_rows | since(5)>("bytes", &Frame::bytes),
                        field<not_visited>("header", &Frame::header));
    }
};
template <>
struct FieldsOf<AirFrame> {
    static constexpr auto fields() {
        return describe(field("frame", &AirFrame::frame),
                        field("heard_from", &AirFrame::heard_from),
                        field("kind", &AirFrame::control), field("attempt", &AirFrame::attempt),
                        field("number", &AirFrame::number), field("reserved", &AirFrame::reserved));
    }
};
template <>
struct FieldsOf<Leg> {
    static constexpr auto fields() {
        return describe(field("start", &Leg::start), field("end", &Leg::end),
                        field("from", &Leg::from), field<not_hashed>("velocity", &Leg::velocity),
                        field("to", &Leg::to), field<not_hashed>("heading", &Leg::heading),
                        field<not_hashed>("turning", &Leg::turning));
    }
};

template <>
struct FieldsOf<Reception> {
    static constexpr auto fields() {
        return describe(field("node", &Reception::node), field("time", &Reception::time),
                        field("fate", &Reception::fate), field("delivered", &Reception::delivered),
                        field<not_visited>("locked", &Reception::locked));
    }
};

/// Struct with a description: a record, or a part of one.
template <class T>
concept DescribedPart = requires {
    FieldsOf<std::remove_const_t<T>>::fields();
};

/// Calls visit(field) for each field of a record or of a part, in the order of the description.
template <DescribedPart Part, class Visitor>
constexpr void for_each_field_of(Visitor&& visit) {
    FieldsOf<std::remove_const_t<Part>>::fields().for_each(visit);
}

}  // namespace rovernet
