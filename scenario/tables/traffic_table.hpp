// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

// Traffic in a scenario file:
//
//     [[traffic]]
//     from = "A"
//     payload = "hello"
//     start = "1 s"
//     every = "3 s"
//     count = 20

namespace rovernet {

/// Values of [[traffic]] kind: messages to everyone, or to one robot.
enum class TrafficKind { broadcast, unicast };
template <>
struct EnumNames<TrafficKind> {
    static constexpr std::array<std::string_view, 2> values = {"broadcast", "unicast"};
};

/// Allowed message sizes [bytes]: range of the key `size` of [[traffic]] and of reactions.
inline constexpr Range sizes_of_messages{
    .low = 0,
    .high = longest_message,
    .text = "from 0 to 65507 bytes, which fit into a UDP packet"};

/// [[traffic]]: one flow of messages. The robot `from` sends a message at time `start`, and repeats
/// it at intervals of `every` until the time `stop`, or until `count` messages are sent.
struct TrafficTable {
    TrafficKind kind = TrafficKind::broadcast;
    /// Name of the flow, the suffix of its metrics' names; see name_flows().
    std::string name = {};
    /// Name of the sending robot. With "random", if no robot has this name, the sender of each
    /// message is drawn from all robots except the destination.
    std::string from;
    /// Name of the robot to which unicasts are sent.
    std::optional<std::string> to;
    /// Hop limit of the messages. 1: the messages are sent over one hop, without the routing
    /// protocol. None: the routing protocol forwards the messages if it can, see Network::send.
    std::optional<int> hops;
    /// True for a saturated source: the next message is queued as soon as the previous one is sent.
    /// Requires a medium access model.
    bool saturate = false;
    /// Text that the message carries.
    std::string payload;
    /// Size of the message on air [bytes]; none: the length of the payload.
    std::optional<Bytes> size;
    /// Time of the first message since the start of the run [ns]; none: the time at which the robot
    /// `from` arrives at the end of its movement.
    std::optional<Duration> start;
    /// Interval between messages [ns]; none: one message only.
    std::optional<Duration> every;
    /// End of the flow [ns], and largest number of messages; none: no limit.
    std::optional<Duration> stop;
    std::optional<int> count;
    /// File positions of the keys `from`, `to`, `hops`, `start` and `payload`, for errors and
    /// notices.
    Location from_where = {}, to_where = {}, hops_where = {}, start_where = {}, payload_where = {};
    /// True if the flow is of a traffic file, where it can have no key `hops`.
    bool is_of_file = false;

    /// Word for the key `start`: the first message is sent when the robot arrives.
    static constexpr std::string_view at_arrival = "arrival";

    /// Keys of the table, without `start`.
    static constexpr auto fields() {
        constexpr Range one{
            .low = 1, .high = 1, .text = "of 1: over one hop, without the routing protocol"};
        constexpr Range counts{.low = 1, .text = ">= 1"};
        using T = TrafficTable;
        return describe(
            field("kind", &T::kind,
                  "broadcast: the messages are for every robot; unicast: they are for the robot "
                  "`to`"),
            field("name", &T::name, "name of the flow, which the names of its metrics contain"),
            field("from", &T::from, "robot that sends the messages"),
            field("to", &T::to, "robot that should receive the messages"),
            field("hops", &T::hops, one,
                  "1: the messages go over one hop, without the routing protocol"),
            field(
                "saturate", &T::saturate,
                "true: the sender sends the next message as soon as the previous message is sent"),
            field("payload", &T::payload, "text of the message"),
            field("size", &T::size, sizes_of_messages,
                  "size of the message on air; if not given, the length of `payload`"),
            field("every", &T::every, positive,
                  "time from one message to the next; if not given, one message is sent"),
            field("stop", &T::stop, non_negative, "no message is sent at or after this time"),
            field("count", &T::count, counts, "number of messages"));
    }
};

/// Reads one flow of [[traffic]]. A table that names a traffic file is read by read_flows().
/// @throws InputError for a key that is unknown, is missing, or contradicts another key
TrafficTable read_traffic(const Value& value);

}  // namespace rovernet
