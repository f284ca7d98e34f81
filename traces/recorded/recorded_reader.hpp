// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "traces/recorded/bytes.hpp"
#include "traces/recorded/mcap_reader.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Data of a recorded trace about its run, without the records.
struct RecordedRun {
    /// Version of the program that wrote the trace.
    std::string version;
    /// Scenario as TOML, with all defaults; empty if the network was built by a C++ program.
    std::string scenario;
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    /// Names of the robots by NodeId.
    std::vector<std::string> robots;
    /// Digest of the walls of the scenario's Stage world; empty: not known.
    std::string walls;
    /// Files that the scenario refers to.
    std::vector<AttachedFile> files;
    /// Names of attached files that are broken; their content is not known.
    std::vector<std::string> broken;
    /// True if the attached file robots.txt, with the names of the robots, is complete.
    bool has_names = true;

    /// Description of `robots` for error messages: number of robots with names, and whether the
    /// attached file of names is missing or broken.
    std::string names_in_words() const;
};

/// Whether the file begins like a recorded trace. False for a pipe, because it can be read only
/// once.
/// @throws InputError if the file has the extension of a recorded trace (.mcap), but another
///         content
bool is_recorded_trace(const std::string& path);

/// Reader of the records of a recorded trace, in the order of the run, with the legs and messages
/// at the time of each record. The reader can drive any sink: metrics, fingerprint and ns-2 trace
/// equal those of the run.
///
///     RecordedReader reader("runs/rescue-s7/trace.mcap");
///     while (const Record* record = reader.next()) sink.on(*record, reader.context());
///
/// Every message id of a record is in the context's message table. Every robot id of a record has a
/// name in the trace, except robots that a C++ program added to its network later.
///
/// Records lack the keys of random draws (0) and the levels of receptions (empty). Frame::header is
/// 1 in a Received whose message was transmitted with a header, otherwise 0. An incomplete
/// file is read up to its last complete chunk. A broken chunk is skipped: after the chunk, messages
/// are correct immediately, and the position of a robot is correct from its next leg on. Memory
/// grows with the number of robots and of messages in use, not with records.
class RecordedReader {
  public:
    /// Opens the file and reads the parts before the records.
    /// @throws InputError if it is not a recorded trace, or of an unknown version
    explicit RecordedReader(const std::string& path);

    const RecordedRun& run() const { return run_; }
    /// Format number of the trace, see recorded_format. Fields that only later formats store have
    /// their default values.
    unsigned format() const { return format_; }
    /// Next record, valid until the next call; null at the end.
    /// @throws InputError for a robot that the trace does not name, or for too many flows
    const Record* next();
    /// Legs and messages at the time of the last record that next() returned, and the header of its
    /// frame if it is an AirSent.
    RecordContext context() const {
        return {legs_, messages_, nullptr, header_.bytes.empty() ? nullptr : &header_};
    }
    /// Passes all remaining records to a sink: calls begin(), on() for each record, and finish().
    /// @throws InputError as next()
    void read(const Sink& sink);
    /// Sentences about the broken and missing parts of the trace found so far.
    const std::vector<std::string>& damage() const { return file_.damage(); }
    /// Time of the last record so far.
    Time now() const { return now_; }
    /// Number of the chunk of the last record; the first chunk of the file is 0.
    std::uint32_t chunk() const { return chunks_ - 1; }
    /// Continues reading at the start of a chunk, which must not precede the current chunk. The
    /// messages of the context are then correct, but its legs are still the legs of the previous
    /// position. The trace must be free of damage.
    void go_to_chunk(std::uint32_t chunk);

  private:
    void read_metadata(std::string_view content);
    void read_attachment(std::string_view content);
    void read_channel(std::string_view content);
    void leave_out(std::string& kind);
    bool begin_chunk();
    void tell_missing_chunks(std::string_view statistics);
    bool take_message(std::string_view content);
    bool define(std::string_view bytes);
    bool take_header(std::string_view bytes);
    bool has_message(const Record& record) const;
    void complete(Record& record);
    void meet(const Record& record);
    void meet(NodeId robot);
    [[noreturn]] void fail(const std::string& message) const;

    std::string path_;
    McapReader file_;
    RecordedRun run_;
    unsigned format_ = 1;
    // Names of the record kinds of later versions, by channel; a name is empty once reported.
    std::map<std::uint16_t, std::string> later_kinds_;
    ByteReader chunk_{{}};  // rest of the current chunk
    std::uint64_t chunk_offset_ = 0;
    std::uint32_t chunks_ = 0;   // number of chunks so far
    std::uint64_t records_ = 0;  // number of records so far
    Time now_ = start_of_run;
    Record record_;
    bool has_record_ = false;  // true: the last message was a record, not a definition
    // Header of the last record's frame, and header of the next record's frame; no bytes: none.
    FrameHeader header_, next_header_;
    std::vector<Reception> receptions_;
    Legs legs_;
    MessageTable messages_;
    std::vector<std::optional<MessageId>> slots_;  // message ids by slots of the file
    std::vector<bool> has_header_;  // by MessageId: the message was transmitted with a header
    std::set<std::string, std::less<>>
        kinds_;  // texts to which Message::kind and FrameHeader::protocol refer
};

}  // namespace rovernet
