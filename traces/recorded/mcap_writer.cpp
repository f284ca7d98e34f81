// SPDX-License-Identifier: MIT
#include "traces/recorded/mcap_writer.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <zstd.h>

namespace rovernet {
namespace {

// Higher levels take longer than the run itself and save little, because the columns are already
// small.
constexpr int level = 1;

void put_record(ByteWriter& to, McapOpcode opcode, std::string_view content) {
    to.fixed(static_cast<std::uint8_t>(opcode));
    to.fixed(std::uint64_t{content.size()});
    to.bytes(content);
}

}  // namespace

std::uint32_t mcap_crc(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void McapChunk::begin_message(std::uint16_t channel, std::uint64_t time) {
    constexpr std::uint32_t sequence = 0;  // the order is that of the file
    ByteWriter& index = indexes_[channel];
    index.fixed(time);
    index.fixed(std::uint64_t{bytes_.size()});
    bytes_.fixed(static_cast<std::uint8_t>(McapOpcode::message));
    begun_ = bytes_.size();
    bytes_.fixed(std::uint64_t{0});
    bytes_.fixed(channel);
    bytes_.fixed(sequence);
    bytes_.fixed(time);
    bytes_.fixed(time);
    first_ = std::min(first_, time);
    last_ = std::max(last_, time);
}

void McapChunk::end_message() {
    bytes_.overwrite(begun_, std::uint64_t{bytes_.size() - begun_ - sizeof(std::uint64_t)});
}

void McapWriter::Free::operator()(ZSTD_CCtx_s* packer) const { ZSTD_freeCCtx(packer); }

McapWriter::McapWriter(const std::string& path, std::string_view profile, std::string_view library)
    : file_(path, PartFile::Failed::is_kept), packer_(ZSTD_createCCtx()) {
    write_bytes(mcap_magic);
    ByteWriter content;
    content.text(profile);
    content.text(library);
    write_record(McapOpcode::header, content.view());
}

void McapWriter::metadata(std::string_view name,
                          const std::map<std::string, std::string>& entries) {
    ByteWriter map, content, index;
    for (const auto& [key, value] : entries) {
        map.text(key);
        map.text(value);
    }
    content.text(name);
    content.text(map.view());
    index.fixed(written_);
    index.fixed(std::uint64_t{mcap_record_head + content.size()});
    index.text(name);
    put_record(metadata_index_, McapOpcode::metadata_index, index.view());
    ++metadata_;
    write_record(McapOpcode::metadata, content.view());
}

void McapWriter::attach(const AttachedFile& file) {
    ByteWriter content, index;
    const auto times_and_name = [&](ByteWriter& to) {
        to.fixed(std::uint64_t{0});  // [ns] of its record, then of its making: neither is kept, so
        to.fixed(std::uint64_t{0});  // that the same run writes the same bytes
    };
    times_and_name(content);
    content.text(file.name);
    content.text(file.type);
    content.fixed(std::uint64_t{file.content.size()});
    content.bytes(file.content);
    content.fixed(mcap_crc(content.view()));
    index.fixed(written_);
    index.fixed(std::uint64_t{mcap_record_head + content.size()});
    times_and_name(index);
    index.fixed(std::uint64_t{file.content.size()});
    index.text(file.name);
    index.text(file.type);
    put_record(attachment_index_, McapOpcode::attachment_index, index.view());
    ++attachments_;
    write_record(McapOpcode::attachment, content.view());
}

void McapWriter::declare(const McapChannel& declared) {
    ByteWriter schema, channel;
    schema.fixed(declared.number);
    schema.text(declared.schema_name);
    schema.text(declared.schema_encoding);
    schema.text(declared.schema);
    put_record(schemas_, McapOpcode::schema, schema.view());
    write_record(McapOpcode::schema, schema.view());
    channel.fixed(declared.number);
    channel.fixed(declared.number);
    channel.text(declared.topic);
    channel.text(declared.encoding);
    channel.text("");  // no metadata of its own
    put_record(channels_, McapOpcode::channel, channel.view());
    write_record(McapOpcode::channel, channel.view());
    ++declared_;
}

void McapWriter::declare(std::uint16_t number, std::string_view topic, std::string_view layout) {
    constexpr std::string_view encoding = "rovernet";
    const std::string name = fmt::format("rovernet.{}", topic);
    declare({.number = number,
             .topic = topic,
             .encoding = encoding,
             .schema_name = name,
             .schema_encoding = encoding,
             .schema = layout});
}

void McapWriter::write(const McapChunk& chunk) {
    const std::string_view plain = chunk.bytes_.view();
    packed_.resize(ZSTD_compressBound(plain.size()));
    const std::size_t size = ZSTD_compressCCtx(packer_.get(), packed_.data(), packed_.size(),
                                               plain.data(), plain.size(), level);
    if (ZSTD_isError(size)) throw RunError(fmt::format("zstd: {}", ZSTD_getErrorName(size)));
    constexpr std::string_view compression = "zstd";
    ByteWriter content, index;
    content.fixed(chunk.first_);
    content.fixed(chunk.last_);
    content.fixed(std::uint64_t{plain.size()});
    content.fixed(mcap_crc(plain));
    content.text(compression);
    content.fixed(std::uint64_t{size});
    content.bytes({packed_.data(), size});
    const std::uint64_t begin = written_;
    write_record(McapOpcode::chunk, content.view());
    const std::uint64_t end = written_;
    const std::string places = write_message_indexes(chunk);
    index.fixed(chunk.first_);
    index.fixed(chunk.last_);
    index.fixed(begin);
    index.fixed(end - begin);
    index.text(places);
    index.fixed(written_ - end);
    index.text(compression);
    index.fixed(std::uint64_t{size});
    index.fixed(std::uint64_t{plain.size()});
    put_record(chunk_index_, McapOpcode::chunk_index, index.view());
    ++chunks_;
    first_ = std::min(first_, chunk.first_);
    last_ = std::max(last_, chunk.last_);
}

/// Writes an index of the chunk's messages for each of its channels, and counts the messages.
/// @return the channels, each with the position of its index in the file
std::string McapWriter::write_message_indexes(const McapChunk& chunk) {
    constexpr std::size_t entry = 2 * sizeof(std::uint64_t);
    ByteWriter places;
    for (const auto& [channel, entries] : chunk.indexes_) {
        counts_[channel] += entries.size() / entry;
        places.fixed(channel);
        places.fixed(written_);
        ByteWriter content;
        content.fixed(channel);
        content.text(entries.view());
        write_record(McapOpcode::message_index, content.view());
    }
    return std::string(places.view());
}

std::string McapWriter::statistics() const {
    ByteWriter content, by_channel;
    std::uint64_t messages = 0;
    for (const auto& [channel, count] : counts_) {
        by_channel.fixed(channel);
        by_channel.fixed(count);
        messages += count;
    }
    content.fixed(messages);
    content.fixed(declared_);                              // schemas
    content.fixed(static_cast<std::uint32_t>(declared_));  // channels
    content.fixed(attachments_);
    content.fixed(metadata_);
    content.fixed(chunks_);
    content.fixed(messages == 0 ? std::uint64_t{0} : first_);
    content.fixed(last_);
    content.text(by_channel.view());
    return std::string(content.view());
}

void McapWriter::finish() {
    ByteWriter data_end, offsets, footer;
    data_end.fixed(std::uint32_t{0});  // no CRC of the whole: each chunk has one
    write_record(McapOpcode::data_end, data_end.view());
    const std::uint64_t summary = written_;
    summary_crc_ = 0;
    write_group(McapOpcode::schema, schemas_, offsets);
    write_group(McapOpcode::channel, channels_, offsets);
    ByteWriter numbers;
    put_record(numbers, McapOpcode::statistics, statistics());
    write_group(McapOpcode::statistics, numbers, offsets);
    write_group(McapOpcode::chunk_index, chunk_index_, offsets);
    write_group(McapOpcode::attachment_index, attachment_index_, offsets);
    write_group(McapOpcode::metadata_index, metadata_index_, offsets);
    const std::uint64_t summary_offsets = written_;
    write_bytes(offsets.view());
    footer.fixed(static_cast<std::uint8_t>(McapOpcode::footer));
    footer.fixed(std::uint64_t{20});
    footer.fixed(summary);
    footer.fixed(summary_offsets);
    write_bytes(footer.view());
    footer.clear();
    footer.fixed(summary_crc_);
    write_bytes(footer.view());
    write_bytes(mcap_magic);
    file_.close();
}

void McapWriter::write_group(McapOpcode opcode, ByteWriter& records, ByteWriter& offsets) {
    if (records.size() == 0) return;
    ByteWriter offset;
    offset.fixed(static_cast<std::uint8_t>(opcode));
    offset.fixed(written_);
    offset.fixed(std::uint64_t{records.size()});
    put_record(offsets, McapOpcode::summary_offset, offset.view());
    write_bytes(records.view());
}

void McapWriter::write_record(McapOpcode opcode, std::string_view content) {
    ByteWriter head;
    head.fixed(static_cast<std::uint8_t>(opcode));
    head.fixed(std::uint64_t{content.size()});
    write_bytes(head.view());
    write_bytes(content);
}

void McapWriter::write_bytes(std::string_view bytes) {
    summary_crc_ = static_cast<std::uint32_t>(
        crc32_z(summary_crc_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
    written_ += bytes.size();
    file_.write(bytes);
}

}  // namespace rovernet
