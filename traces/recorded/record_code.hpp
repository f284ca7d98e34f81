// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/recorded/bytes.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Encoding of records in a recorded trace. docs/formats/trace-format.md describes it for other
// readers. The time of a record is stored by the container, all other data here.
//
// Letters of the layouts: `v` unsigned varint, `z` signed varint (folded), `b` one byte, `d` 8
// bytes of a double, `s` a varint of the length and that many bytes. `node?` is 0 for everyone or
// none, otherwise the node's number + 1. `n * x` is a column: n values of x in a row.

namespace rovernet {

/// Version of the layouts of records in a recorded trace; a reader refuses any later version. A
/// field that is added to the records of an earlier version is described with since(VERSION).
inline constexpr std::uint32_t recorded_format = 5;

/// Number by which a recorded trace stores the kind of a frame: 0 for a data frame (`control` is
/// null), 1 for RTS, 2 for CTS, 3 for ACK, 4 for any other control frame.
std::uint8_t number_of(const ControlFrame* control);

/// Kind of message in a recorded trace: its topic, and the layout of its bytes.
struct RecordedKind {
    std::string_view topic;
    std::string layout;
};

/// Kinds of messages in a recorded trace, at index channel - 1: first the definition of a message,
/// then the records in the order of their bits. The layouts follow from the fields of the records.
std::vector<RecordedKind> recorded_kinds();

/// Channel (MCAP) of the definitions of messages. Records of the kind with index i in Record have
/// channel i + 2, see channel_of().
inline constexpr std::uint16_t message_channel = 1;
constexpr std::uint16_t channel_of(std::size_t index) {
    return static_cast<std::uint16_t>(index + 2);
}

/// Channel of the headers of frames (FrameHeader): the header is in the frame of the AirSent that
/// follows. Kinds of records have channels below, see bit_in().
inline constexpr std::uint16_t header_channel = 30;
/// Topic and layout of the headers.
RecordedKind recorded_header();

/// Time under which the container stores a record: for a Received the time of its first reception.
/// A Received without receptions gets `otherwise`.
Time time_of(const Record& record, Time otherwise);

/// Appends the bytes of a record whose time is `time`.
void encode(const Record& record, Time time, ByteWriter& to);
/// Appends the bytes of the definition of the message in `slot` at `time`.
void encode(const Message& message, MessageId slot, Time time, ByteWriter& to);

/// Appends the bytes of the header of a frame.
void encode(const FrameHeader& header, ByteWriter& to);

/// Decodes a record from its bytes, on the channel of its kind.
/// @param receptions  receives the receptions of a Received, to which the record then points
/// @param format      version of the layouts of the trace
/// @return whether the bytes are a valid record: of the right length, with all values in range
bool decode(std::uint16_t channel, Time time, std::string_view bytes,
            std::vector<Reception>& receptions, Record& record, unsigned format = recorded_format);
/// Decodes the definition of a message from its bytes.
/// @param kind    receives the text of Message::kind, which the caller has to store
/// @param format  version of the layouts of the trace; a message has a port from version 3 on
/// @return whether the bytes are a valid definition
bool decode(Time time, std::string_view bytes, MessageId& slot, Message& message,
            std::string_view& kind, unsigned format = recorded_format);

/// Decodes the header of a frame from its bytes.
/// @param protocol  receives the text of FrameHeader::protocol, which the caller has to store
/// @return whether the bytes are a valid header
bool decode(std::string_view bytes, FrameHeader& header, std::string_view& protocol);

}  // namespace rovernet
