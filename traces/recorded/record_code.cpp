// SPDX-License-Identifier: MIT
#include "traces/recorded/record_code.hpp"

#include <cmath>
#include <limits>
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

/// Encodes the fields of a record.
class Encoder {
  public:
    Encoder(ByteWriter& to, Time time) : to_(to), time_(time) {}

    void operator()(const Sent& r) {
        put(r.node), put(r.message), put(r.ttl), put(r.robots);
        put(r.reachable ? std::uint64_t{*r.reachable} + 1 : 0);
    }
    void operator()(const Transmitted& r) {
        put(r.frame);
        put_optional(r.heard_from.value_or(everyone));
    }
    void operator()(const Received& r) {
        put(r.frame);
        to_.signed_varint(r.reserved.count());
        put(r.header), put(r.receptions.size());
        char* at = to_.room(r.receptions.size() * (2 * longest_varint + 1));
        Time time = time_;
        for (const Reception& rx : r.receptions) {
            at = write_varint(at, folded((rx.time - std::exchange(time, rx.time)).count()));
        }
        std::int64_t node = r.frame.sender.value;
        for (const Reception& rx : r.receptions) {
            const std::int64_t here = rx.node.value;
            at = write_varint(at, folded(here - std::exchange(node, here)));
        }
        for (const Reception& rx : r.receptions) *at++ = static_cast<char>(packed_fate(rx));
        to_.end_at(at);
    }
    void operator()(const Dropped& r) {
        put(r.node), put(r.frame);
        to_.fixed(static_cast<std::uint8_t>(r.reason));
    }
    void operator()(const Moved& r) {
        const Leg& leg = r.leg;
        const std::uint8_t parts = parts_of(leg);
        put(r.node);
        to_.signed_varint((leg.start - time_).count());
        put(leg.end == never ? 0 : folded((leg.end - leg.start).count()) + 1);
        put(leg.from);
        to_.fixed(parts);
        if (parts & moves) put(leg.velocity), put(leg.to);
        if (parts & heads) to_.real(leg.heading);
        if (parts & turns) to_.real(leg.turning);
    }
    void operator()(const Arrived& r) { put(r.node); }
    void operator()(const NoWay& r) { put(r.node), put(r.goal); }
    void operator()(const Switched& r) {
        put(r.node);
        to_.fixed(static_cast<std::uint8_t>(r.on));
    }
    void operator()(const LinkUp& r) { put(r.from), put(r.to); }
    void operator()(const LinkDown& r) { put(r.from), put(r.to); }
    void operator()(const AirSent& r) { put(r.air), put(r.bytes); }
    void operator()(const ControlReceived& r) {
        put(r.air), put(r.reception.node);
        to_.fixed(packed_fate(r.reception));
        put(r.bytes);
    }

  private:
    void put(std::uint64_t value) { to_.varint(value); }
    void put(NodeId node) { put(node.value); }
    void put(MessageId message) { put(message.value); }
    void put_optional(NodeId node) { put(node.value + 1U); }
    void put(Vec3 v) { to_.real(v.x), to_.real(v.y), to_.real(v.z); }
    void put(const Frame& frame) {
        put(frame.message), put(frame.sender), put(frame.ttl), put(frame.hops);
        put_optional(frame.next_hop);
    }
    void put(const AirFrame& air) {
        put(air.frame);
        put_optional(air.heard_from.value_or(everyone));
        to_.fixed(static_cast<std::uint8_t>(air.kind));
        to_.fixed(air.attempt);
        put(air.number);
        to_.signed_varint(air.reserved.count());
    }

    ByteWriter& to_;
    Time time_;
};

/// Decodes the fields of a record. A value out of its range counts as missing bytes.
class Decoder {
  public:
    Decoder(std::string_view bytes, Time time, std::vector<Reception>& receptions)
        : from_(bytes), time_(time), receptions_(receptions) {}

    template <class R>
    R record();
    bool is_done() const { return from_.is_done() && in_range_; }

  private:
    template <class Integer>
    Integer whole() {
        const std::uint64_t value = from_.varint();
        if (value > std::numeric_limits<Integer>::max()) in_range_ = false;
        return static_cast<Integer>(value);
    }
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
    NodeId node() {
        const NodeId node{whole<std::uint32_t>()};
        if (node == everyone) in_range_ = false;
        return node;
    }
    NodeId node_or_everyone() { return {whole<std::uint32_t>() - 1U}; }
    std::optional<NodeId> node_or_none() {
        const NodeId node = node_or_everyone();
        return node == everyone ? std::nullopt : std::optional(node);
    }
    MessageId message() { return {whole<std::uint32_t>()}; }
    /// Number that is valid as a position or a speed, as in a Network.
    double real() {
        constexpr double largest = 1e15;
        const double value = from_.real();
        if (!(std::abs(value) <= largest)) in_range_ = false;
        return value;
    }
    Vec3 vector() {
        const double x = real(), y = real(), z = real();
        return {x, y, z};
    }
    Frame frame() {
        Frame frame{.message = message(), .sender = node()};
        frame.ttl = whole<Hops>();
        frame.hops = whole<Hops>();
        frame.next_hop = node_or_everyone();
        return frame;
    }
    AirFrame air() {
        AirFrame air{.frame = frame(), .heard_from = node_or_none()};
        air.kind = static_cast<AirFrame::Kind>(byte(AirFrame::ack));
        air.attempt = byte(255);
        air.number = whole<std::uint32_t>();
        air.reserved = Duration{from_.signed_varint()};
        return air;
    }
    void take_fate(Reception& rx) {
        const std::uint8_t fate = byte(2 * static_cast<unsigned>(last_fate) + 1);
        rx.fate = static_cast<Fate>(fate / 2);
        rx.delivered = fate % 2 != 0;
    }
    void take_receptions(NodeId sender) {
        const auto n = from_.varint();
        // A reception takes at least three bytes; larger counts are damage and get no memory.
        receptions_.resize(n <= from_.left() / 3 ? n : 0);
        if (receptions_.size() != n) in_range_ = false;
        Time time = time_;
        for (Reception& rx : receptions_) rx.time = time = after(time, from_.signed_varint());
        auto node = std::int64_t{sender.value};
        for (Reception& rx : receptions_) {
            const std::int64_t step = from_.signed_varint();
            constexpr std::int64_t end = everyone.value;
            if (step < -node || step >= end - node) in_range_ = false;
            node = in_range_ ? node + step : 0;
            rx.node = NodeId{static_cast<std::uint32_t>(node)};
        }
        for (Reception& rx : receptions_) take_fate(rx);
    }

    ByteReader from_;
    Time time_;
    std::vector<Reception>& receptions_;
    bool in_range_ = true;
};

template <>
Sent Decoder::record<Sent>() {
    Sent r{.time = time_,
           .node = node(),
           .message = message(),
           .ttl = whole<Hops>(),
           .robots = 0,
           .reachable = {}};
    r.robots = whole<std::uint32_t>();
    const auto reachable = from_.varint();
    if (reachable > 0) r.reachable = static_cast<std::uint32_t>(reachable - 1);
    if (reachable > std::uint64_t{1} << 32) in_range_ = false;
    return r;
}
template <>
Transmitted Decoder::record<Transmitted>() {
    return {.time = time_, .frame = frame(), .heard_from = node_or_none()};
}
template <>
Received Decoder::record<Received>() {
    Received r{.frame = frame(), .receptions = {}};
    r.reserved = Duration{from_.signed_varint()};
    r.header = whole<std::uint32_t>();
    take_receptions(r.frame.sender);
    r.receptions = receptions_;
    return r;
}
template <>
Dropped Decoder::record<Dropped>() {
    return {.time = time_,
            .node = node(),
            .frame = frame(),
            .reason = static_cast<DropReason>(byte(static_cast<unsigned>(last_drop_reason)))};
}
template <>
Moved Decoder::record<Moved>() {
    Moved r{.time = time_, .node = node(), .leg = {}};
    Leg& leg = r.leg;
    leg.start = after(time_, from_.signed_varint());
    const auto end = from_.varint();
    if (end > 0) leg.end = after(leg.start, unfolded(end - 1));
    if (leg.end < leg.start) in_range_ = false;
    leg.from = leg.to = vector();
    const auto parts = byte(moves | heads | turns);
    if (parts & moves) {
        leg.velocity = vector();
        leg.to = vector();
    }
    if (parts & heads) leg.heading = real();
    if (parts & turns) leg.turning = real();
    return r;
}
template <>
Arrived Decoder::record<Arrived>() {
    return {.time = time_, .node = node()};
}
template <>
NoWay Decoder::record<NoWay>() {
    return {.time = time_, .node = node(), .goal = vector()};
}
template <>
Switched Decoder::record<Switched>() {
    return {.time = time_, .node = node(), .on = byte(1) != 0};
}
template <>
LinkUp Decoder::record<LinkUp>() {
    return {.time = time_, .from = node(), .to = node()};
}
template <>
LinkDown Decoder::record<LinkDown>() {
    return {.time = time_, .from = node(), .to = node()};
}
template <>
AirSent Decoder::record<AirSent>() {
    return {.time = time_, .air = air(), .bytes = whole<std::uint32_t>()};
}
template <>
ControlReceived Decoder::record<ControlReceived>() {
    ControlReceived r{.air = air(), .reception = {.time = time_, .node = node()}, .bytes = 0};
    take_fate(r.reception);
    r.bytes = whole<std::uint32_t>();
    return r;
}

/// Calls visit<R>() for the type R with that index in Record.
template <class Visit, std::size_t... index>
bool with_kind(std::size_t place, Visit visit, std::index_sequence<index...>) {
    return ((index == place &&
             visit(std::type_identity<std::variant_alternative_t<index, Record>>{})) ||
            ...);
}

}  // namespace

Time time_of(const Record& record, Time otherwise) {
    return std::visit(
        [&](const auto& r) -> Time {
            using R = std::decay_t<decltype(r)>;
            if constexpr (std::is_same_v<R, Received>) {
                return r.receptions.empty() ? otherwise : r.receptions.front().time;
            } else if constexpr (std::is_same_v<R, ControlReceived>) {
                return r.reception.time;
            } else {
                return r.time;
            }
        },
        record);
}

void encode(const Record& record, Time time, ByteWriter& to) {
    std::visit(Encoder(to, time), record);
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
            std::vector<Reception>& receptions, Record& record) {
    const auto take = [&](auto kind) {
        Decoder from(bytes, time, receptions);
        record = from.record<typename decltype(kind)::type>();
        return from.is_done();
    };
    constexpr auto kinds = std::make_index_sequence<std::variant_size_v<Record>>();
    return channel >= channel_of(0) && with_kind(channel - channel_of(0), take, kinds);
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
