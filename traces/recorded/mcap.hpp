// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// MCAP, the container format of a recorded trace. A file consists of the bytes mcap_magic, records,
// and mcap_magic again. A record is an opcode (1 byte), the length of the content (8 bytes) and the
// content.
// Source: the MCAP format specification, https://mcap.dev/spec, version 0.

namespace rovernet {

/// First and last bytes of an MCAP file.
inline constexpr std::string_view mcap_magic{"\x89MCAP0\r\n", 8};
/// Size of opcode and length before the content of an MCAP record [bytes].
inline constexpr std::size_t mcap_record_head = 9;

/// Kinds of records of an MCAP file.
enum class McapOpcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    attachment = 0x09,
    attachment_index = 0x0a,
    statistics = 0x0b,
    metadata = 0x0c,
    metadata_index = 0x0d,
    summary_offset = 0x0e,
    data_end = 0x0f,
};

/// File attached to a recorded trace.
struct AttachedFile {
    std::string name;
    /// Media type of the file, such as text/plain.
    std::string type;
    std::string content;
};

/// CRC-32 of an MCAP file's bytes: the CRC-32 of zlib (ISO 3309).
std::uint32_t mcap_crc(std::string_view bytes);

}  // namespace rovernet
