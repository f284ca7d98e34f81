// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/bytes.hpp"
#include "traces/recorded/field_writer.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rovernet {

/// Largest valid number of an enumeration that is a field of records, by the argument's type.
constexpr unsigned last_of(Fate) { return static_cast<unsigned>(last_fate); }
constexpr unsigned last_of(DropReason) { return static_cast<unsigned>(last_drop_reason); }
/// Control frames of a recorded trace, at index number_of() - 1. Sizes are 0, since the record of a
/// frame stores the frame's size.
inline constexpr std::array<ControlFrame, 4> control_frames{
    {{"RTS", 0}, {"CTS", 0}, {"ACK", 0}, {"CTL", 0}}};

/// Reader of the fields of records from bytes that FieldWriter wrote. It has an overload of take()
/// for each type of field. If bytes are missing or a value is out of range, is_done() is false.
class FieldReader {
  public:
    FieldReader(std::string_view bytes, Time time, unsigned format,
                std::vector<Reception>& receptions)
        : from_(bytes), time_(time), format_(format), receptions_(receptions) {}

    bool is_done() const { return from_.is_done() && in_range_; }

    template <DescribedPart Part>
    void take(Part& part) {
        if constexpr (requires { part.time; }) part.time = time_;
        for_each_recorded<Part>([&]<class Field>(const Field& f) {
            auto& value = part.*f.member;
            if (first_format(Field::use) > format_) return;
            if constexpr ((Field::use & or_everyone) != 0) {
                value = node_or_everyone();
            } else {
                take(value);
            }
        });
    }
    void take(Leg& leg) {
        take(leg.start);
        const auto end = from_.varint();
        if (end > 0) leg.end = after(leg.start, unfolded(end - 1));
        if (leg.end < leg.start) in_range_ = false;
        take(leg.from);
        leg.to = leg.from;
        const auto parts = byte(LegParts::all);
        if (parts & LegParts::moves) take(leg.velocity), take(leg.to);
        if (parts & LegParts::heads) take(leg.heading);
        if (parts & LegParts::turns) take(leg.turning);
    }
    void take(Frame& frame) {
        take<Frame>(frame);
        sender_ = frame.sender;
    }
    void take(Reception& rx) {
        rx.time = time_;
        take(rx.node);
        take_fate(rx);
    }
    void take(std::span<const Reception>& receptions) {
        const auto n = from_.varint();
        // A reception takes at least three bytes; larger counts are damage and get no memory.
        receptions_.resize(n <= from_.left() / 3 ? n : 0);
        if (receptions_.size() != n) in_range_ = false;
        Time time = time_;
        for (Reception& rx : receptions_) rx.time = time = after(time, from_.signed_varint());
        auto node = std::int64_t{sender_.value};
        for (Reception& rx : receptions_) {
            const std::int64_t step = from_.signed_varint();
            constexpr std::int64_t end = everyone.value;
            if (step < -node || step >= end - node) in_range_ = false;
            node = in_range_ ? node + step : 0;
            rx.node = NodeId{static_cast<std::uint32_t>(node)};
        }
        for (Reception& rx : receptions_) take_fate(rx);
        receptions = receptions_;
    }

  private:
    std::uint8_t byte(unsigned last) {
        const auto value = from_.fixed<std::uint8_t>();
        if (value > last) in_range_ = false;
        return value;
    }
    /// Time `before` plus a duration; the result must lie between 0 and `never`.
    Time after(Time before, std::int64_t ns) {
        const std::int64_t begin = before.time_since_epoch().count();
        if (ns > 0 ? ns > never.time_since_epoch().count() - begin : begin + ns < 0) {
            in_range_ = false;
            return before;
        }
        return before + Duration{ns};
    }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void take(Enum& value) { value = static_cast<Enum>(byte(last_of(value))); }
    void take(bool& value) { value = byte(1) != 0; }
    void take(const ControlFrame*& control) {
        const std::uint8_t number = byte(control_frames.size());
        control = number > 0 && in_range_ ? &control_frames[number - 1U] : nullptr;
    }
    void take(std::uint8_t& value) { value = byte(255); }
    template <std::integral T>
    void take(T& value) {
        const auto number = [&] {
            if constexpr (std::signed_integral<T>) return from_.signed_varint();
            if constexpr (std::unsigned_integral<T>) return from_.varint();
        }();
        value = static_cast<T>(number);
        if (!std::in_range<T>(number)) in_range_ = false;
    }
    void take(NodeId& node) {
        take(node.value);
        if (node == everyone) in_range_ = false;
    }
    void take(MessageId& message) { take(message.value); }
    void take(Time& time) { time = after(time_, from_.signed_varint()); }
    /// Duration from the time of the record on; its end must lie between that time and `never`.
    void take(Duration& duration) {
        const std::int64_t ns = from_.signed_varint();
        if (ns < 0) in_range_ = false;
        duration = after(time_, ns) - time_;
    }
    /// Reads a number that is valid as a position or a speed: at most 1e15 in magnitude.
    void take(double& value) {
        constexpr double largest = 1e15;
        value = from_.real();
        if (!(std::abs(value) <= largest)) in_range_ = false;
    }
    void take(Vec3& v) { take(v.x), take(v.y), take(v.z); }
    template <Quantitative T>
    void take(T& quantity) {
        take(quantity.value);
    }
    void take(std::optional<NodeId>& node) {
        const NodeId found = node_or_everyone();
        node = found == everyone ? std::nullopt : std::optional(found);
    }
    template <std::unsigned_integral T>
    void take(std::optional<T>& value) {
        const std::uint64_t number = from_.varint();
        value = number > 0 ? std::optional(static_cast<T>(number - 1)) : std::nullopt;
        if (number > 0 && !std::in_range<T>(number - 1)) in_range_ = false;
    }
    NodeId node_or_everyone() {
        std::uint32_t number = 0;
        take(number);
        return {number - 1U};
    }
    void take_fate(Reception& rx) {
        const std::uint8_t fate = byte(2 * static_cast<unsigned>(last_fate) + 1);
        rx.fate = static_cast<Fate>(fate / 2);
        rx.delivered = fate % 2 != 0;
    }

    ByteReader from_;
    Time time_;
    unsigned format_;
    std::vector<Reception>& receptions_;
    NodeId sender_{0};  // sender of the record's frame
    bool in_range_ = true;
};

}  // namespace rovernet
