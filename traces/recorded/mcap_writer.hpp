// SPDX-License-Identifier: MIT
#pragma once

#include "files/part_file.hpp"
#include "traces/recorded/bytes.hpp"
#include "traces/recorded/mcap.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

struct ZSTD_CCtx_s;  // compression context of zstd

namespace rovernet {

/// Schema of an MCAP file, and the channel for its messages. Both have the same number.
struct McapChannel {
    std::uint16_t number = 0;
    std::string_view topic;
    /// Encoding of the messages, such as "json".
    std::string_view encoding;
    /// Name, encoding and text of the schema.
    std::string_view schema_name, schema_encoding, schema;
};

/// Messages of an MCAP chunk before the chunk is packed.
class McapChunk {
  public:
    /// Begins a message on a channel; its content is written to bytes() until end_message().
    /// @param time  time of the message [ns]
    void begin_message(std::uint16_t channel, std::uint64_t time);
    void end_message();
    ByteWriter& bytes() { return bytes_; }
    void clear() { *this = McapChunk(std::move(bytes_)); }
    McapChunk() = default;

  private:
    friend class McapWriter;
    explicit McapChunk(ByteWriter bytes) : bytes_(std::move(bytes)) { bytes_.clear(); }

    ByteWriter bytes_;
    std::size_t begun_ = 0;  // position of the current message's length field
    // Times of the first and the last message in the chunk [ns].
    std::uint64_t first_ = ~std::uint64_t{0}, last_ = 0;
    std::map<std::uint16_t, ByteWriter> indexes_;  // time and position of each message, by channel
};

/// Writer of MCAP files: first metadata, attachments, schemas and channels; then chunks packed with
/// zstd, each followed by an index of its messages; then the summary with an index of the chunks.
/// The message indexes take 16 bytes per message, not packed; some readers need them. Source: the
/// MCAP format specification, https://mcap.dev/spec.
class McapWriter {
  public:
    /// Opens the file. This function and all functions below throw RunError if writing fails.
    McapWriter(const std::string& path, std::string_view profile, std::string_view library);

    void metadata(std::string_view name, const std::map<std::string, std::string>& entries);
    void attach(const AttachedFile& file);
    /// Declares a schema, and its channel.
    void declare(const McapChannel& channel);
    /// Declares the schema of messages of a recorded trace, and its channel, in the encoding
    /// "rovernet".
    void declare(std::uint16_t number, std::string_view topic, std::string_view layout);
    /// Packs and writes the messages of a chunk.
    void write(const McapChunk& chunk);
    /// Writes the summary, and completes the file.
    void finish();
    /// Path of the incomplete file, NAME.N.part; readers may already read the chunks written so
    /// far.
    const std::string& part() const { return file_.part(); }
    /// Renames the finished file from its temporary name to its final name.
    void give_name() { file_.give_name(); }

  private:
    struct Free {
        void operator()(ZSTD_CCtx_s* packer) const;
    };

    std::string write_message_indexes(const McapChunk& chunk);
    void write_record(McapOpcode opcode, std::string_view content);
    void write_bytes(std::string_view bytes);
    /// Writes a group of records, and an offset record for them in the summary.
    void write_group(McapOpcode opcode, ByteWriter& records, ByteWriter& offsets);
    std::string statistics() const;

    PartFile file_;
    std::uint64_t written_ = 0;      // bytes written so far
    std::uint32_t summary_crc_ = 0;  // CRC of the bytes written since it was set to 0
    std::unique_ptr<ZSTD_CCtx_s, Free> packer_;
    std::string packed_;
    ByteWriter schemas_, channels_, chunk_index_, attachment_index_, metadata_index_;
    std::uint32_t chunks_ = 0, attachments_ = 0, metadata_ = 0;
    std::uint16_t declared_ = 0;
    std::map<std::uint16_t, std::uint64_t> counts_;
    std::uint64_t first_ = ~std::uint64_t{0}, last_ = 0;
};

}  // namespace rovernet
