// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "traces/recorded/bytes.hpp"
#include "traces/recorded/mcap_reader.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// What a recorded trace says of its run.
struct RecordedRun {
    /// Version of the program that wrote it.
    std::string version;
    /// Scenario as TOML, every default filled in; empty: a network that was made in code.
    std::string scenario;
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    /// Names of the robots by NodeId.
    std::vector<std::string> robots;
    /// Files that the scenario names.
    std::vector<AttachedFile> files;
    /// Names of files inside that are broken: what they hold is not known.
    std::vector<std::string> broken;
    /// A whole robots.txt is inside, which may be empty.
    bool has_names = true;

    /// Number of robots that have names, and why there is none if it is no file that says so.
    std::string names_in_words() const;
};

/// Whether the file begins as a recorded trace does. A pipe is none: what it has can be read once.
bool is_recorded_trace(const std::string& path);

/// Gives the records of a recorded trace back, in the order of the run, with legs and messages as
/// they were then. Any sink can be driven by it: metrics, fingerprint and ns-2 trace come out as
/// they would have in the run.
///
///     RecordedReader reader("runs/rescue-s7/trace.mcap");
///     while (const Record* record = reader.next()) sink.on(*record, reader.context());
///
/// Whatever a record is about can be looked up: its robots are among those that the trace names,
/// and its message is defined. Robots of a network that was made in code may have been added later;
/// they have no names.
///
/// Not in the records: keys of random draws (0), and levels of receptions (none). A file without an
/// end is read up to its last whole chunk. A broken chunk is left out: behind it the messages are
/// right at once, and the place of a robot from its next leg on. Memory grows with robots and
/// messages that are under way, not with records.
class RecordedReader {
  public:
    /// Opens the file and reads what stands before the records.
    /// @throws InputError if it is no recorded trace, or of a version that is not known
    explicit RecordedReader(const std::string& path);

    const RecordedRun& run() const { return run_; }
    /// Next record, good until the next call; null at the end.
    /// @throws InputError if it is of a robot that the trace does not name, or of a flow too many
    const Record* next();
    /// Legs and messages as the run had them when it made the record.
    RecordContext context() const { return {legs_, messages_}; }
    /// Drives a sink by all records that are left: begin, on, finish. @throws InputError as next()
    void read(const Sink& sink);
    /// What is broken or missing in what was read so far, as sentences; empty: nothing.
    const std::vector<std::string>& damage() const { return file_.damage(); }
    /// Time of the last record so far.
    Time now() const { return now_; }

  private:
    void read_metadata(std::string_view content);
    void read_attachment(std::string_view content);
    bool begin_chunk();
    void tell_missing_chunks(std::string_view statistics);
    bool take_message(std::string_view content);
    bool define(std::string_view bytes);
    bool has_message(const Record& record) const;
    void meet(const Record& record);
    void meet(NodeId robot);
    [[noreturn]] void fail(const std::string& message) const;

    std::string path_;
    McapReader file_;
    RecordedRun run_;
    ByteReader chunk_{{}};  // what is left of the current chunk
    std::uint64_t chunk_offset_ = 0;
    std::uint32_t chunks_ = 0;   // so far
    std::uint64_t records_ = 0;  // so far
    Time now_ = start_of_run;
    Record record_;
    bool has_record_ = false;  // the last message was a record, not a definition
    std::vector<Reception> receptions_;
    Legs legs_;
    MessageTable messages_;
    std::vector<std::optional<MessageId>> slots_;  // our messages by slots of the file
    std::set<std::string, std::less<>> kinds_;     // that Message::kind refers to
};

}  // namespace rovernet
