// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "study/measurement.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A point as a store keeps it.
struct StoredPoint {
    std::uint32_t number;  ///< place in the study, from 0
    std::string id;        ///< see Study
    Table settings;        ///< path -> value
};

/// A run as a store keeps it, finished or failed.
struct StoredRun {
    std::string id;       ///< see run_id()
    std::uint32_t point;  ///< number of the point
    std::uint32_t replication;
    std::string error;        ///< empty: finished
    Measurement measurement;  ///< measurement; without metrics for a failed run
};

/// Value of a metric in a run.
struct StoredValue {
    std::uint32_t point, replication;
    std::optional<double> value;
};

/// The results of one study in one SQLite file.
///
/// Tables: `study` (key, value: version, scenario, created), `point`, `run`, `metric_name`,
/// `metric` (a value per run and metric); the view `result` joins them. A run enters in one
/// transaction: it is there whole or not at all, whatever happens to this process. One process
/// writes at a time; others may read meanwhile. Not for files shared between machines.
///
/// What is read is checked, column by column: a damaged store is an InputError that names table and
/// row, from every function.
class Store {
  public:
    /// Opens a store for reading. @throws InputError if there is none, or of a newer format
    static Store open(const std::string& path);
    /// Opens a store for writing, or makes one. @throws InputError as open(); RunError if somebody
    /// else writes to it, or it cannot be written
    static Store open_to_write(const std::string& path);
    ~Store();
    Store(Store&&) noexcept;
    Store& operator=(Store&&) noexcept;

    /// Property of the study: "version", "scenario", "created"; empty if there is none.
    std::string property(const std::string& key) const;
    /// Property that is written in JSON; an empty Value if there is none.
    Value document(const std::string& key) const;
    void set_property(const std::string& key, const std::string& value);

    /// Points in the order of their numbers.
    std::vector<StoredPoint> points() const;
    /// The study's points: new ones are added, known ones get their number. All that the store has
    /// must be among them.
    void set_points(const std::vector<StoredPoint>& points);

    /// Runs in order of point and replication, without their metrics.
    std::vector<StoredRun> runs() const;
    /// Keeps a run, in place of one of the same id that failed.
    void record(const StoredRun& run);

    /// The metrics of its runs, in the order in which they first came.
    std::vector<std::string> metric_names() const;
    /// The values of one metric in the finished runs (of one point), in order of point and
    /// replication.
    std::vector<StoredValue> values(const std::string& metric,
                                    std::optional<std::uint32_t> point = {}) const;
    /// Metrics of all finished runs, in order of point, replication and metric's name.
    void for_each_value(
        const std::function<void(const StoredValue&, const std::string& metric)>& visit) const;

    /// Answers a question in SQL, row by row; NULL is an empty text. The first call has the names.
    /// @throws std::invalid_argument with SQLite's words if the question is wrong or would write
    void query(const std::string& sql,
               const std::function<void(const std::vector<std::string>&)>& row) const;

    const std::string& path() const { return path_; }

  private:
    struct Database;
    Store(std::string path, std::unique_ptr<Database> database);

    std::string path_;
    std::unique_ptr<Database> database_;
};

}  // namespace rovernet
