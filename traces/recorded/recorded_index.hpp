// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/record.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace rovernet {

/// Index of a recorded trace: for each message the chunks with its records, and for each chunk the
/// robots' legs and states at its start. With the index, a reader finds all records of a message by
/// reading a few chunks:
///
///     for (const auto& range : index.chunks_of(uid)) {
///         reader.go_to_chunk(range.begin);
///         index.for_each_before(range.begin, [&](const Record& record) { ... });
///         for (std::uint64_t i = 0; i < range.records; ++i) use(*reader.next());
///     }
///
/// Memory: 72 bytes for each pair of a chunk and a robot that begins a leg in it, 32 bytes for each
/// pair of a message and a chunk with its records, and the slots of the message table.
class RecordedIndex {
  public:
    /// Adds the next record of the run.
    /// @param chunk  number of the record's chunk, see RecordedReader::chunk()
    void add(std::uint32_t chunk, const Record& record, const RecordContext& context);

    /// Chunks that follow each other; `end` is not included.
    struct Range {
        std::uint32_t begin, end;
        std::uint64_t records;  ///< number of records in these chunks
    };
    /// Chunks with all records of a message, and with all frames that are on air together with a
    /// frame of the message, in ascending order.
    std::vector<Range> chunks_of(std::uint64_t uid) const;
    /// Whether some record is of this message.
    bool has(std::uint64_t uid) const;
    /// Chunks with all frames that are on air at a robot between two times.
    std::vector<Range> chunks_between(Time from, Time to) const;
    /// Calls visit(record) for the records that determine the state of the robots at the start of a
    /// chunk: the last Moved of each robot, and the last Switched of each robot that was switched
    /// on or off.
    void for_each_before(std::uint32_t chunk,
                         const std::function<void(const Record&)>& visit) const;
    /// Whether the trace contains the airtimes of frames; formats 1 and 2 do not. Without airtimes,
    /// chunks_of() and chunks_between() miss some frames.
    bool knows_airtimes() const { return knows_airtimes_; }

  private:
    struct Chunk {
        std::uint32_t number;
        Time first, last;
        std::uint64_t records = 0;
    };
    /// Records of a message in a chunk.
    struct Mention {
        std::uint64_t uid;
        std::size_t chunk;  // index in chunks_
        Time first, last;
    };
    /// Value that is valid from the start of a chunk on.
    template <class T>
    struct From {
        std::uint32_t chunk;
        T value;
    };
    template <class T>
    using Values = std::map<NodeId, std::vector<From<T>>>;

    template <class T>
    static void set(Values<T>& all, NodeId node, std::uint32_t chunk, const T& value);
    template <class T, class Visit>
    static void for_each(const Values<T>& all, std::uint32_t chunk, const Visit& visit);
    void append(std::vector<Range>& ranges, std::size_t& end, std::size_t first,
                std::size_t last) const;
    /// Longest time from the start of a frame at its sender to its end at a receiver.
    Duration longest_on_air() const;
    void mention(std::uint64_t uid, MessageId slot);

    std::vector<Chunk> chunks_;
    std::vector<Mention> mentions_;     // mentions of all messages, in the order of the chunks
    std::vector<std::size_t> last_of_;  // index in mentions_ of the last mention of each message,
                                        // by MessageId
    Values<Leg> legs_;
    Values<bool> switched_;
    Duration longest_airtime_{0};
    bool knows_airtimes_ = true;
};

}  // namespace rovernet
