// SPDX-License-Identifier: MIT
#include "traces/recorded/mcap_reader.hpp"

#include "files/kept_inputs.hpp"
#include "files/text_source.hpp"
#include "sim/error.hpp"
#include "traces/recorded/bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

namespace rovernet {
namespace {

// Chunks of rovernet have about 1 MB; a much larger size means damage.
constexpr std::uint64_t largest_chunk = 64 << 20;
// Opcode and length of a chunk, times, size and CRC; then its compression.
constexpr std::uint64_t before_compression = mcap_record_head + 8 + 8 + 8 + 4;
constexpr std::string_view zstd_text{"\4\0\0\0zstd", 8};

std::string_view mapped(const std::string& path) {
    const auto fail = [&] {
        throw InputError({.source = path},
                         fmt::format("cannot open the trace: {}", std::strerror(errno)));
    };
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail();
    struct stat status {};
    void* bytes = nullptr;
    const bool is_there = fstat(file, &status) == 0;
    const auto size = static_cast<std::size_t>(status.st_size);
    if (is_there && size > 0) bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    const int error = errno;
    close(file);
    errno = error;
    if (!is_there || bytes == MAP_FAILED) fail();
    note_input(path);
    return bytes ? std::string_view(static_cast<const char*>(bytes), size) : std::string_view();
}

}  // namespace

McapReader::McapReader(const std::string& path) : file_(mapped(path)), at_(mcap_magic.size()) {
    if (file_.starts_with(mcap_magic)) return;
    const std::string kind(foreign_kind(file_.substr(0, 512)));
    unmap();
    if (!kind.empty())
        throw InputError({.source = path},
                         kind + "; expected a recorded trace (.mcap), not compressed");
    throw InputError({.source = path},
                     "this file is not a recorded trace; expected a file in the format MCAP, as "
                     "\"rovernet run --record\" writes it");
}

McapReader::~McapReader() { unmap(); }

void McapReader::unmap() {
    if (!file_.empty()) munmap(const_cast<char*>(file_.data()), file_.size());
}

/// Whether a complete record of a possible kind begins at this position.
bool McapReader::is_record_at(std::uint64_t at) const {
    if (at > file_.size() || file_.size() - at < mcap_record_head) return false;
    ByteReader head(file_.substr(at, mcap_record_head));
    const auto opcode = head.fixed<std::uint8_t>();
    const auto length = head.fixed<std::uint64_t>();
    return opcode >= static_cast<std::uint8_t>(McapOpcode::header) &&
           opcode <= static_cast<std::uint8_t>(McapOpcode::data_end) &&
           length <= file_.size() - at - mcap_record_head;
}

/// Whether a complete chunk begins at this position, judged by its lengths.
bool McapReader::is_chunk_at(std::uint64_t at) const {
    if (!is_record_at(at)) return false;
    ByteReader head(file_.substr(at, mcap_record_head));
    head.fixed<std::uint8_t>();
    ByteReader content(file_.substr(at + mcap_record_head, head.fixed<std::uint64_t>()));
    content.take(8 + 8 + 8 + 4);  // times, size and CRC
    content.text();               // compression
    content.take(content.fixed<std::uint64_t>());
    return file_[at] == static_cast<char>(McapOpcode::chunk) && content.is_done();
}

/// Whether the records from this position on lead to a chunk or to the end of the data. Bytes
/// inside a record may look like one or two records, but hardly like such a sequence.
bool McapReader::leads_on(std::uint64_t at) const {
    constexpr int most = 64;  // behind a chunk there are fewer before the next
    for (int i = 0; i < most && at != file_.size(); ++i) {
        if (!is_record_at(at)) return false;
        ByteReader head(file_.substr(at, mcap_record_head));
        const auto opcode = static_cast<McapOpcode>(head.fixed<std::uint8_t>());
        const auto length = head.fixed<std::uint64_t>();
        if (opcode == McapOpcode::chunk) return is_chunk_at(at);
        if (opcode == McapOpcode::data_end) return length == sizeof(std::uint32_t);
        at += mcap_record_head + length;
    }
    return at == file_.size();
}

/// Whether the record at this position is valid: bytes that only look like an end or an index would
/// not be followed by valid records.
bool McapReader::is_sound(const McapRecord& record) const {
    const std::uint64_t behind = record.offset + mcap_record_head + record.content.size();
    const std::string_view rest = file_.substr(behind, mcap_magic.size());
    if (record.opcode == McapOpcode::footer) return mcap_magic.starts_with(rest);
    return record.opcode != McapOpcode::message_index || leads_on(behind);
}

/// Place of the next chunk from `from` on; the end of the file if there is none.
std::uint64_t McapReader::next_chunk(std::uint64_t from) const {
    for (std::size_t found = file_.find(zstd_text, from); found != std::string_view::npos;
         found = file_.find(zstd_text, found + 1)) {
        if (found < from + before_compression) continue;
        const std::uint64_t at = found - before_compression;
        if (file_[at] == static_cast<char>(McapOpcode::chunk) && is_record_at(at)) return at;
    }
    return file_.size();
}

std::optional<McapRecord> McapReader::next() {
    if (at_ >= file_.size() || has_end_) {
        if (!has_end_) tell("the end is missing");
        has_end_ = true;
        return std::nullopt;
    }
    if (!is_record_at(at_)) {
        skip_to_chunk();
        return next();
    }
    ByteReader head(file_.substr(at_, mcap_record_head));
    McapRecord record{.opcode = static_cast<McapOpcode>(head.fixed<std::uint8_t>()),
                      .content = {},
                      .offset = at_};
    record.content = file_.substr(at_ + mcap_record_head, head.fixed<std::uint64_t>());
    if (!is_sound(record)) {
        skip_to_chunk();
        return next();
    }
    at_ += mcap_record_head + record.content.size();
    if (record.opcode == McapOpcode::footer) {
        has_end_ = file_.substr(at_, mcap_magic.size()) == mcap_magic;
        at_ = file_.size();
    }
    return record;
}

/// Moves to the next chunk.
void McapReader::skip_to_chunk() {
    const std::uint64_t chunk = next_chunk(at_ + 1);
    const bool is_last = chunk == file_.size();
    // A chunk that was being written when the writer died is part of the missing end.
    if (!is_last) tell(fmt::format("bytes {} to {} are damaged", at_, chunk));
    at_ = chunk;
}

std::optional<McapMessages> McapReader::unpack(const McapRecord& chunk) {
    ByteReader from(chunk.content);
    McapMessages messages{
        .first = from.fixed<std::uint64_t>(), .last = from.fixed<std::uint64_t>(), .records = {}};
    const auto size = from.fixed<std::uint64_t>();
    const auto crc = from.fixed<std::uint32_t>();
    const std::string_view compression = from.text();
    const std::string_view packed = from.take(from.fixed<std::uint64_t>());
    const auto broken = [&](std::string_view why) {
        tell(fmt::format("the chunk of the trace at byte {} ({:.6f} to {:.6f} s) is damaged: {}",
                         chunk.offset, static_cast<double>(messages.first) / 1e9,
                         static_cast<double>(messages.last) / 1e9, why));
        return std::nullopt;
    };
    if (!from.is_done()) {
        // Not after a chunk that it covers, and not into the following data.
        const std::uint64_t chunk_behind = next_chunk(chunk.offset + 1);
        if (at_ > chunk_behind || !leads_on(at_)) at_ = chunk_behind;
        return broken("its length is wrong");
    }
    if (compression != "zstd" && !compression.empty()) return broken("its compression is unknown");
    if (size > largest_chunk) return broken("its size is wrong");
    if (compression.empty()) {
        plain_ = packed;
    } else {
        plain_.resize(size);
        const auto n = ZSTD_decompress(plain_.data(), size, packed.data(), packed.size());
        if (ZSTD_isError(n) || n != size) return broken("it cannot be decompressed");
    }
    if (crc != 0 && mcap_crc(plain_) != crc) return broken("its checksum differs");
    messages.records = plain_;
    return messages;
}

}  // namespace rovernet
