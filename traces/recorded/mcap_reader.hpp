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
    /// Place of its opcode in the file [bytes].
    std::uint64_t offset;
};

/// Chunk that has been unpacked.
struct McapMessages {
    /// First and last time of its messages [ns].
    std::uint64_t first, last;
    /// Records in it; good until the next chunk is unpacked.
    std::string_view records;
};

/// Goes through the records of an MCAP file from its begin, also of a file that is damaged or has
/// no end. Where what should be a record is none, it goes on at the next chunk. The file is mapped
/// into memory, not read into it.
class McapReader {
  public:
    /// @throws InputError if the file cannot be opened, or does not begin as MCAP does
    explicit McapReader(const std::string& path);
    McapReader(const McapReader&) = delete;
    ~McapReader();

    /// Next record; nothing at the end.
    std::optional<McapRecord> next();
    /// Goes back to that record.
    void go_to(const McapRecord& record) { at_ = record.offset; }
    /// Unpacks a chunk. @return nothing if it is broken, which damage() then tells
    std::optional<McapMessages> unpack(const McapRecord& chunk);
    /// Adds to damage().
    void tell(std::string text) { damage_.push_back(std::move(text)); }
    /// What is broken or missing, as far as the file was gone through; empty: nothing.
    const std::vector<std::string>& damage() const { return damage_; }

  private:
    void unmap();
    bool is_record_at(std::uint64_t at) const;
    std::uint64_t next_chunk(std::uint64_t from) const;

    std::string_view file_;
    std::uint64_t at_;
    bool has_end_ = false;
    std::string plain_;  // bytes of the last chunk
    std::vector<std::string> damage_;
};

}  // namespace rovernet
