// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/bytes.hpp"
#include "traces/recorded/record_code.hpp"

#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace rovernet {

/// Bits for the parts of a leg (piece of movement) that are written to a recorded trace. Without a
/// bit, the part is omitted: velocity, heading or turning is then 0, and Leg::to equals Leg::from.
struct LegParts {
    static constexpr std::uint8_t moves = 1, heads = 2, turns = 4;
    static constexpr std::uint8_t all = moves | heads | turns;
};

/// Writer of the fields of records and their parts, as bytes of a recorded trace. There is an
/// overload of put() for each type of field. docs/formats/trace-format.md describes the bytes.
class FieldWriter {
  public:
    FieldWriter(ByteWriter& to, Time time) : to_(to), time_(time) {}

    template <DescribedPart Part>
    void put(const Part& part) {
        for_each_recorded<Part>([&]<class Field>(const Field& f) {
            const auto& value = part.*f.member;
            if constexpr ((Field::use & or_everyone) != 0) {
                put_optional(value);
            } else {
                put(value);
            }
        });
    }
    void put(const Leg& leg) {
        const std::uint8_t parts = parts_of(leg);
        put(leg.start);
        to_.varint(leg.end == never ? 0 : folded((leg.end - leg.start).count()) + 1);
        put(leg.from);
        to_.fixed(parts);
        if (parts & LegParts::moves) put(leg.velocity), put(leg.to);
        if (parts & LegParts::heads) put(leg.heading);
        if (parts & LegParts::turns) put(leg.turning);
    }
    void put(const Frame& frame) {
        sender_ = frame.sender;
        put<Frame>(frame);
    }
    void put(const Reception& rx) {
        put(rx.node);
        to_.fixed(packed_fate(rx));
    }
    void put(std::span<const Reception> receptions) {
        to_.varint(receptions.size());
        char* at = to_.room(receptions.size() * (2 * longest_varint + 1));
        Time time = time_;
        for (const Reception& rx : receptions) {
            at = write_varint(at, folded((rx.time - std::exchange(time, rx.time)).count()));
        }
        std::int64_t node = sender_.value;
        for (const Reception& rx : receptions) {
            const std::int64_t here = rx.node.value;
            at = write_varint(at, folded(here - std::exchange(node, here)));
        }
        for (const Reception& rx : receptions) *at++ = static_cast<char>(packed_fate(rx));
        to_.end_at(at);
    }

  private:
    template <OneByte T>
    void put(T value) {
        to_.fixed(static_cast<std::uint8_t>(value));
    }
    template <std::unsigned_integral T>
    requires(!OneByte<T>) void put(T value) { to_.varint(value); }
    template <std::signed_integral T>
    void put(T value) {
        to_.signed_varint(value);
    }
    void put(NodeId node) { to_.varint(node.value); }
    void put(MessageId message) { to_.varint(message.value); }
    void put(Time time) { put(time - time_); }
    void put(Duration duration) { to_.signed_varint(duration.count()); }
    void put(const ControlFrame* control) { to_.fixed(number_of(control)); }
    void put(double value) { to_.real(value); }
    void put(Vec3 v) { put(v.x), put(v.y), put(v.z); }
    template <Quantitative T>
    void put(T quantity) {
        put(quantity.value);
    }
    void put(std::optional<NodeId> node) { put_optional(node.value_or(everyone)); }
    template <std::unsigned_integral T>
    void put(std::optional<T> value) {
        to_.varint(value ? std::uint64_t{*value} + 1 : 0);
    }
    void put_optional(NodeId node) { to_.varint(node.value + 1U); }

    static std::uint8_t packed_fate(const Reception& rx) {
        return static_cast<std::uint8_t>(2 * static_cast<unsigned>(rx.fate) +
                                         (rx.delivered ? 1 : 0));
    }
    /// Whether two numbers have equal bits; 0 and -0 differ.
    static bool are_same(double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    }
    static bool are_same(Vec3 a, Vec3 b) {
        return are_same(a.x, b.x) && are_same(a.y, b.y) && are_same(a.z, b.z);
    }
    static std::uint8_t parts_of(const Leg& leg) {
        const bool moves = !are_same(leg.velocity, {}) || !are_same(leg.from, leg.to);
        return static_cast<std::uint8_t>((moves ? LegParts::moves : 0) |
                                         (are_same(leg.heading, 0) ? 0 : LegParts::heads) |
                                         (are_same(leg.turning, 0) ? 0 : LegParts::turns));
    }

    ByteWriter& to_;
    Time time_;
    NodeId sender_{0};  // sender of the record's frame
};

}  // namespace rovernet
