// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/read_value.hpp"
#include "scenario/document/value.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

// Traffic as a scenario file gives it:
//
//     [[traffic]]
//     from = "A"
//     payload = "hello"
//     start = "1 s"
//     every = "3 s"
//     count = 20

namespace rovernet {

/// Words of [[traffic]] kind: messages to everyone by the routing protocol, or to one robot in one
/// hop.
enum class TrafficKind { broadcast, unicast };
template <>
struct EnumNames<TrafficKind> {
    static constexpr std::array<std::string_view, 2> values = {"broadcast", "unicast"};
};

/// [[traffic]]: one flow. `from` sends a message at `start`, and every `every` from then on until
/// `stop`, or until it was sent `count` times.
struct TrafficTable {
    TrafficKind kind = TrafficKind::broadcast;
    /// Name of the flow, which ends the names of its metrics; see name_flows().
    std::string name = {};
    /// Robot that sends; "random", if no robot has that name: another robot each time.
    std::string from;
    /// Robot that a unicast is for.
    std::optional<std::string> to;
    /// There is always a message to send: a new one as soon as one is sent. It needs an access
    /// model.
    bool saturate = false;
    /// Text of the message.
    std::string payload;
    /// Size on air; none: the length of the payload.
    std::optional<Bytes> size;
    /// Time of the first message [ns]; none: when `from` arrives at the end of its movement.
    std::optional<Duration> start;
    /// Interval between messages [ns]; none: there is one message.
    std::optional<Duration> every;
    /// Time from which on none is sent [ns], and number of messages at most; none: no end.
    std::optional<Duration> stop;
    std::optional<int> count;
    /// Places of keys, for errors and notices.
    Location from_where = {}, to_where = {}, payload_where = {};
};

/// Reads one flow of [[traffic]]; not one that names a file, see read_flows().
/// @throws InputError for a key that is unknown, missing, or contradicts another
TrafficTable read_traffic(const Value& value);

}  // namespace rovernet
