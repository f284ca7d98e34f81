// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/tables/move_table.hpp"
#include "scenario/tables/traffic_table.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Reactions of a robot in a scenario file:
//
//     on_receive = { payload = "stop", stop = true }
//     on_time = [{ time = "5 s", send = "A" }, { time = "9 s", send = "B" }]

namespace rovernet {

/// Trigger of a reaction: the event to which the robot reacts. Each enumerator has the name of its
/// key in [[robot]].
enum class Trigger {
    /// The robot receives a message.
    on_receive,
    /// The robot comes to rest at the end of a movement.
    on_arrival,
    /// The link from any other robot to the reacting robot is lost.
    on_link_lost,
    /// A given time of the run is reached.
    on_time
};
/// Key of a [[robot]] table for each Trigger, in the order of printing.
template <>
struct EnumNames<Trigger> {
    static constexpr std::array<std::string_view, 4> values = {"on_receive", "on_arrival",
                                                               "on_link_lost", "on_time"};
};

/// Reaction of a robot to an event: on_receive = { ... }, on_arrival, on_link_lost or on_time. A
/// list of tables stands for several reactions. At least one of `move`, `send` and `stop` is given.
struct ReactionTable {
    Trigger trigger{};
    /// Text with which the payload of the received message must begin; empty: any message. Used by
    /// on_receive.
    std::string payload = {};
    /// Robot that sent the message, or whose link is lost; none: any robot. Used by on_receive and
    /// on_link_lost.
    std::optional<std::string> from = {};
    /// Largest number of hops of the message; none: any number. Used by on_receive.
    std::optional<int> hops = {};
    /// Time of the reaction since the start of the run [ns]. Used by on_time.
    Duration time{0};
    /// True if the robot reacts only to the first event of the trigger; false: to all events. Not
    /// used by on_time, which happens once.
    bool once = true;
    /// Movement that the robot starts in reaction to the event `trigger`; none: no movement.
    std::optional<MoveTable> move = {};
    /// Payload of the message that the robot sends in reaction to the event `trigger`; none: no
    /// message is sent.
    std::optional<std::string> send = {};
    /// Destination of the message that the robot sends: a robot's name, or "sender"; none:
    /// everyone.
    std::optional<std::string> to = {};
    /// Size [bytes] of the message that the robot sends; none: the length of its payload.
    std::optional<Bytes> size = {};
    /// True if the robot stops at its current position; excludes `move`.
    bool stop = false;
    /// File positions of the reaction's table, and of its keys `from` and `to`.
    Location where = {}, from_where = {}, to_where = {};

    /// Value of `to` for the origin of the received message, even if a robot is named "sender".
    static constexpr std::string_view sender = "sender";

    /// Keys of the table, without `move`. has_key() returns whether a trigger has a key.
    static constexpr auto fields() {
        constexpr Range hop_counts{.low = 1, .high = 65535, .text = "from 1 to 65535"};
        using R = ReactionTable;
        return describe(
            field("payload", &R::payload,
                  "text with which a message must begin; if not given, the robot reacts to every "
                  "message"),
            field("hops", &R::hops, hop_counts,
                  "the robot reacts only to messages that came over at most this number of hops"),
            field("from", &R::from,
                  "the robot reacts only to messages of this robot, or only if the link from this "
                  "robot is lost"),
            field("time", &R::time, non_negative, "time at which the robot reacts"),
            field("once", &R::once,
                  "true: the robot reacts only to the first such event; false: to each such event"),
            field("send", &R::send, "text of a message that the robot sends"),
            field("to", &R::to,
                  "receiver of the message that the robot sends: the name of a robot, or "
                  "\"sender\", the sender of the received message"),
            field("size", &R::size, sizes_of_messages, "size of the message that the robot sends"),
            field("stop", &R::stop, "true: the robot stops where it is"));
    }
    /// Whether the reaction to this trigger has a key.
    static constexpr bool has_key(Trigger trigger, std::string_view key) {
        const bool receives = trigger == Trigger::on_receive;
        if (key == "payload" || key == "hops") return receives;
        if (key == "from") return receives || trigger == Trigger::on_link_lost;
        if (key == "time") return trigger == Trigger::on_time;
        return key != "once" || trigger != Trigger::on_time;
    }
};

/// Reads a reaction to a trigger.
/// @throws InputError at the first mistake
ReactionTable read_reaction(const Value& value, Trigger trigger);

/// Converts the reactions of a robot to keys of its table: the inverse of read_reaction().
void append_reactions(Table& table, const std::vector<ReactionTable>& reactions);

}  // namespace rovernet
