// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "traces/recorded/mcap.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Sink that writes the run as a recorded trace: all its records, and the data for running it
/// again, in one MCAP file. RecordedReader reads it; docs/formats/trace-format.md describes the
/// format.
///
/// The simulation thread only copies records. When about a megabyte of records is collected, a
/// second thread encodes, packs and writes them as a chunk. At most 4 such batches wait; then the
/// simulation waits. The bytes of the file do not depend on the threads.
///
/// Not stored: keys of random draws (Message::key, Frame::path), and levels of receptions.
class RecordedTrace {
  public:
    /// Contents of the trace file in addition to the run's records, and options of the recording.
    struct Contents {
        /// Version of the program, as text.
        std::string version;
        /// Scenario to store, as TOML; empty: the scenario that begin() receives in RunInfo.
        std::string scenario = {};
        /// Digest of the walls of the scenario's Stage world; empty: no world.
        std::string walls = {};
        /// Files that the scenario refers to.
        std::vector<AttachedFile> files = {};
        /// True: link changes are recorded, too. The network must then search for their times.
        bool links = false;
        /// Size of a chunk [receptions]; each record counts as 12 further receptions.
        std::size_t chunk = 250'000;
    };

    /// Opens the file under the temporary name NAME.N.part; close() renames it to `path`, see
    /// PartFile. The incomplete file is kept if a write fails. @throws RunError if writing fails
    RecordedTrace(const std::string& path, Contents contents);
    RecordedTrace(RecordedTrace&&) noexcept;
    RecordedTrace& operator=(RecordedTrace&&) noexcept;
    /// Ends the writing thread; removes the file unless close() has named it.
    ~RecordedTrace();

    KindMask kinds() const;
    /// Writes the scenario, its seed and the names of the robots.
    void begin(const RunInfo& run);
    /// @throws RunError if the file cannot be written (disk full, for example); the error may come
    ///         some records later
    void on(const Record& record, const RecordContext& context);
    /// Number of the chunk of the next record; the first chunk is 0.
    std::uint32_t chunk() const { return chunks_; }
    /// Writes all records so far. @return path of the incomplete file, for RecordedReader
    /// @throws RunError as on()
    std::string flush();
    /// Writes the remaining records, and completes the file. @throws RunError as on()
    void finish();
    /// Renames the file to its final name, after finish(). @throws RunError if renaming fails
    void close();

  private:
    class Packer;
    struct Batch;

    void hand_over();

    bool links_;
    std::size_t chunk_size_;
    std::uint32_t chunks_ = 0;  // number of chunks handed over to the writing thread
    std::unique_ptr<Packer> packer_;
    std::unique_ptr<Batch> batch_;
};

}  // namespace rovernet
