// SPDX-License-Identifier: MIT
#include "traces/recorded/record_code.hpp"

#include "traces/record_walk.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

std::uint8_t packed_fate(const Reception& rx) {
    return static_cast<std::uint8_t>(2 * static_cast<unsigned>(rx.fate) + (rx.delivered ? 1 : 0));
}

bool is_plain_zero(double value) { return std::bit_cast<std::uint64_t>(value) == 0; }
bool is_plain_zero(Vec3 v) {
    return is_plain_zero(v.x) && is_plain_zero(v.y) && is_plain_zero(v.z);
}
bool are_same_bits(Vec3 a, Vec3 b) {
    const auto same = [](double p, double q) {
        return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q);
    };
    return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

// Parts of a leg that are written.
constexpr std::uint8_t moves = 1, heads = 2, turns = 4;

std::uint8_t parts_of(const Leg& leg) {
    std::uint8_t parts = 0;
    if (!is_plain_zero(leg.velocity) || !are_same_bits(leg.from, leg.to)) parts |= moves;
    if (!is_plain_zero(leg.heading)) parts |= heads;
    if (!is_plain_zero(leg.turning)) parts |= turns;
    return parts;
}

/// Largest value of an enumeration in a record.
constexpr unsigned last_of(Fate) { return static_cast<unsigned>(last_fate); }
constexpr unsigned last_of(DropReason) { return static_cast<unsigned>(last_drop_reason); }
/// Control frames as a trace names them; their size is in the records.
constexpr std::array<ControlFrame, 4> control_frames{
    {{"RTS", 0}, {"CTS", 0}, {"ACK", 0}, {"CTL", 0}}};

/// Encodes the fields of a record.
class Encoder {
  public:
    Encoder(ByteWriter& to, Time time) : to_(to), time_(time) {}

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
        if (parts & moves) put(leg.velocity), put(leg.to);
        if (parts & heads) put(leg.heading);
        if (parts & turns) put(leg.turning);
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

    ByteWriter& to_;
    Time time_;
    NodeId sender_{0};  // of the record's frame
};

/// Decodes the fields of a record. A value out of its range counts as missing bytes.
class Decoder {
  public:
    Decoder(std::string_view bytes, Time time, unsigned format, std::vector<Reception>& receptions)
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
        const auto parts = byte(moves | heads | turns);
        if (parts & moves) take(leg.velocity), take(leg.to);
        if (parts & heads) take(leg.heading);
        if (parts & turns) take(leg.turning);
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
    /// Time plus a duration, both times between 0 and `never`.
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
        const auto number = std::is_signed_v<T> ? from_.signed_varint() : from_.varint();
        value = static_cast<T>(number);
        if (!std::in_range<T>(number)) in_range_ = false;
    }
    void take(NodeId& node) {
        take(node.value);
        if (node == everyone) in_range_ = false;
    }
    void take(MessageId& message) { take(message.value); }
    void take(Time& time) { time = after(time_, from_.signed_varint()); }
    void take(Duration& duration) { duration = Duration{from_.signed_varint()}; }
    /// Number that is valid as a position or a speed, as in a Network.
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
    NodeId sender_{0};  // of the record's frame
    bool in_range_ = true;
};

}  // namespace

std::uint8_t number_of(const ControlFrame* control) {
    if (!control) return 0;
    std::uint8_t number = 1;
    while (number < control_frames.size() && control_frames[number - 1U].name != control->name)
        ++number;
    return number;
}

Time time_of(const Record& record, Time otherwise) {
    return std::visit(
        [&](const auto& r) -> Time {
            if constexpr (requires { r.receptions; }) {
                return r.receptions.empty() ? otherwise : r.receptions.front().time;
            } else if constexpr (requires { r.reception; }) {
                return r.reception.time;
            } else {
                return r.time;
            }
        },
        record);
}

void encode(const Record& record, Time time, ByteWriter& to) {
    std::visit([&](const auto& r) { Encoder(to, time).put(r); }, record);
}

void encode(const Message& message, MessageId slot, Time time, ByteWriter& to) {
    to.varint(slot.value);
    to.varint(message.uid);
    to.varint(message.origin.value);
    to.varint(message.number);
    to.varint(message.to.value + 1U);
    to.varint(message.size);
    to.signed_varint((time - message.created).count());
    to.varint(message.flow);
    to.fixed(static_cast<std::uint8_t>(message.is_routed));
    for (const std::string_view text : {message.kind, std::string_view(message.payload)}) {
        to.varint(text.size());
        to.bytes(text);
    }
}

bool decode(std::uint16_t channel, Time time, std::string_view bytes,
            std::vector<Reception>& receptions, Record& record, unsigned format) {
    Decoder from(bytes, time, format, receptions);
    std::uint16_t its_channel = channel_of(0);
    const auto take = [&]<class R>(std::type_identity<R>) {
        if (channel == its_channel++) from.take(record.emplace<R>());
    };
    const auto take_any = [&]<class... R>(RecordList<R...>) {
        (take(std::type_identity<R>{}), ...);
    };
    take_any(RecordKinds{});
    return channel >= channel_of(0) && channel < its_channel && from.is_done();
}

bool decode(Time time, std::string_view bytes, MessageId& slot, Message& message,
            std::string_view& kind) {
    ByteReader from(bytes);
    bool in_range = true;
    const auto whole = [&] {
        const std::uint64_t value = from.varint();
        if (value > std::numeric_limits<std::uint32_t>::max()) in_range = false;
        return static_cast<std::uint32_t>(value);
    };
    slot = {whole()};
    message.uid = from.varint();
    message.origin = {whole()};
    message.number = whole();
    message.to = {whole() - 1U};
    message.size = whole();
    const std::int64_t age = from.signed_varint();
    const std::int64_t now = time.time_since_epoch().count();
    if (age < 0 || age > now) in_range = false;
    message.created = in_range ? time - Duration{age} : time;
    message.flow = whole();
    message.is_routed = from.fixed<std::uint8_t>() != 0;
    kind = from.take(from.varint());
    message.payload = std::string(from.take(from.varint()));
    return from.is_done() && in_range;
}

}  // namespace rovernet
