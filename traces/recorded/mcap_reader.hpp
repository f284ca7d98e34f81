// SPDX-License-Identifier: MIT
#pragma once

#include "traces/recorded/mcap.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Record of an MCAP file.
struct McapRecord {
    McapOpcode opcode;
    std::string_view content;
    /// Position of the record's opcode in the file [bytes].
    std::uint64_t offset;
};

/// Unpacked chunk of an MCAP file.
struct McapMessages {
    /// Times of the first and the last message in the chunk [ns].
    std::uint64_t first, last;
    /// Records in the chunk; valid until the next chunk is unpacked.
    std::string_view records;
};

/// Reader of the records of an MCAP file in order, also of a file that is damaged or incomplete.
/// After an invalid record the reader continues at the next chunk. The file is memory-mapped.
class McapReader {
  public:
    /// @throws InputError if the file cannot be opened, or does not begin like an MCAP file
    explicit McapReader(const std::string& path);
    McapReader(const McapReader&) = delete;
    ~McapReader();

    /// Next record; empty at the end.
    std::optional<McapRecord> next();
    /// Moves back to a record, so that next() returns this record again.
    void go_to(const McapRecord& record) { at_ = record.offset; }
    /// Unpacks a chunk. @return messages of the chunk; empty if the chunk is broken: a description
    /// of the fault is then added to damage()
    std::optional<McapMessages> unpack(const McapRecord& chunk);
    /// Adds the description of a fault to damage().
    void tell(std::string text) { damage_.push_back(std::move(text)); }
    /// Descriptions of the broken and missing parts of the file found so far.
    const std::vector<std::string>& damage() const { return damage_; }

  private:
    void unmap();
    bool is_record_at(std::uint64_t at) const;
    bool is_chunk_at(std::uint64_t at) const;
    bool leads_on(std::uint64_t at) const;
    bool is_sound(const McapRecord& record) const;
    void skip_to_chunk();
    std::uint64_t next_chunk(std::uint64_t from) const;

    std::string_view file_;
    std::uint64_t at_;
    bool has_end_ = false;
    std::string plain_;  // unpacked bytes of the last chunk
    std::vector<std::string> damage_;
};

}  // namespace rovernet
