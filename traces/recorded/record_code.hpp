// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/recorded/bytes.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Bytes of a record in a recorded trace, and back. docs/trace-format.md tells of them for other
// readers. A record gives its time to the container; everything else is here.
//
// Letters of the layouts: `v` unsigned varint, `z` signed varint (folded), `b` one byte, `d` 8
// bytes of a double, `s` a varint of the length and so many bytes. `node?` is 0 for everyone or
// nobody, else the node's number + 1. `n * x` is a column: n times x, one behind the other.

namespace rovernet {

/// Version of these layouts; a reader refuses any other.
inline constexpr std::uint32_t recorded_format = 1;

/// Kind of message of a recorded trace: its topic, and what its bytes are.
struct RecordedKind {
    std::string_view topic;
    std::string_view layout;
};

/// Layout of a Frame: `message` is a slot that a Message before it has filled.
#define ROVERNET_FRAME "message:v sender:v ttl:v hops:v next_hop:node?"

/// All kinds by channel - 1: the definition of a message, then the records by the bit of their
/// kind.
inline constexpr std::array<RecordedKind, 1 + std::variant_size_v<Record>> recorded_kinds{{
    {"Message",
     "slot:v uid:v origin:v number:v to:node? size:v created:z(before this time) flow:v "
     "is_routed:b kind:s payload:s"},
    {"Sent", "node:v message:v ttl:v robots:v reachable:v(0 unknown, else + 1)"},
    {"Transmitted", ROVERNET_FRAME " heard_from:node?"},
    {"Received", ROVERNET_FRAME
     " reserved:z header:v n:v n*time:z(after the one before, the first after this time) "
     "n*node:z(after the one before, the first after the sender) n*fate:b(2 fate + delivered)"},
    {"Dropped", "node:v " ROVERNET_FRAME " reason:b"},
    {"Moved",
     "node:v start:z(after this time) end:v(0 never, else + 1 - start) from:3d "
     "parts:b(1 velocity:3d to:3d, 2 heading:d, 4 turning:d; what is left out is 0, `to` is "
     "`from`)"},
    {"Arrived", "node:v"},
    {"NoWay", "node:v goal:3d"},
    {"Switched", "node:v on:b"},
    {"LinkUp", "from:v to:v"},
    {"LinkDown", "from:v to:v"},
    {"AirSent", ROVERNET_FRAME " heard_from:node? kind:b attempt:b number:v reserved:z bytes:v"},
    {"ControlReceived",
     ROVERNET_FRAME " heard_from:node? kind:b attempt:b number:v reserved:z node:v "
                    "fate:b(2 fate + delivered) bytes:v"},
}};
#undef ROVERNET_FRAME

/// Channel of the definitions of messages, and of the records of this place in Record.
inline constexpr std::uint16_t message_channel = 1;
constexpr std::uint16_t channel_of(std::size_t index) {
    return static_cast<std::uint16_t>(index + 2);
}

/// Time that the container keeps for a record: a Received's is that of its first reception. A
/// Received without receptions has none of its own and gets `otherwise`.
Time time_of(const Record& record, Time otherwise);

/// Appends the bytes of a record whose time is `time`.
void encode(const Record& record, Time time, ByteWriter& to);
/// Appends the bytes of the message that fills `slot` at `time`.
void encode(const Message& message, MessageId slot, Time time, ByteWriter& to);

/// Record of these bytes, on the channel of its kind.
/// @param receptions  gets those of a Received, to which the record then points
/// @return whether the bytes are a record: neither too short nor too long, all values in their
///         ranges
bool decode(std::uint16_t channel, Time time, std::string_view bytes,
            std::vector<Reception>& receptions, Record& record);
/// Message of these bytes.
/// @param kind  gets the text of Message::kind, which the caller has to keep
/// @return whether the bytes are a message
bool decode(Time time, std::string_view bytes, MessageId& slot, Message& message,
            std::string_view& kind);

}  // namespace rovernet
