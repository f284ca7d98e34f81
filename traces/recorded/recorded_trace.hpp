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

/// Writes the run as a recorded trace: all its records, and what is needed to run it again, in one
/// MCAP file. RecordedReader gives the records back; docs/trace-format.md describes the file.
///
/// The thread of the run only copies records. When about a megabyte of them has come together, a
/// thread of the trace's own makes a chunk of them, packs and writes it. At most 4 such batches
/// wait for it; then the run waits. The bytes of the file do not depend on the threads.
///
/// Not kept: keys of random draws (Message::key, Frame::path), and levels of receptions.
class RecordedTrace {
  public:
    /// What the file holds beside the records.
    struct Contents {
        /// Version of the program, as text.
        std::string version;
        /// Scenario as TOML, in place of the run's own; empty: the run's own.
        std::string scenario = {};
        /// Files that the scenario names.
        std::vector<AttachedFile> files = {};
        /// Changes of links are recorded, too, which costs the search for them.
        bool links = false;
        /// Receptions of a chunk; any record beside them counts as 12.
        std::size_t chunk = 250'000;
    };

    /// Begins the file; `path` itself appears at the end, see PartFile. The part is kept if a write
    /// fails. @throws RunError if it cannot be written
    RecordedTrace(const std::string& path, Contents contents);
    RecordedTrace(RecordedTrace&&) noexcept;
    RecordedTrace& operator=(RecordedTrace&&) noexcept;
    /// Ends the thread; removes the file unless close() has given it its name.
    ~RecordedTrace();

    KindMask kinds() const;
    /// Writes the scenario, its seed and the robots' names.
    void begin(const RunInfo& run);
    /// @throws RunError if the file cannot be written (disk full, say); this may show some records
    ///         late
    void on(const Record& record, const RecordContext& context);
    /// Writes what has not been written, and ends the writing. @throws RunError as on()
    void finish();
    /// Gives the file its name, after finish(). @throws RunError if that cannot be done
    void close();

  private:
    class Packer;
    struct Batch;

    void hand_over();

    bool links_;
    std::size_t chunk_;
    std::unique_ptr<Packer> packer_;
    std::unique_ptr<Batch> batch_;
};

}  // namespace rovernet
