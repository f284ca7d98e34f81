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

/// Point of a study (one combination of values of the varied keys), as stored.
struct StoredPoint {
    std::uint32_t number;  ///< index of the point in the study, from 0
    std::string id;        ///< id of the point, see Study
    Table settings;        ///< value of each varied key, by the path of the key
};

/// Run of a study, finished or failed, as stored.
struct StoredRun {
    std::string id;       ///< id of the run, see run_id()
    std::uint32_t point;  ///< number of the point to which the run belongs
    std::uint32_t replication;
    std::string error;        ///< error message of a failed run; empty: the run finished
    Measurement measurement;  ///< metrics, times and host; a failed run has no metrics
};

/// Value of a metric in a run of a study, as stored.
struct StoredValue {
    std::uint32_t point, replication;
    std::optional<double> value;
};

/// Store of a study: its results in one SQLite file.
///
/// Tables: `study` (key, value: version, scenario, created), `point`, `run`, `metric_name`,
/// `metric` (one value for each run and metric). The view `result` joins these tables. A run is
/// written in one transaction, completely or not at all. One process may write at a time. Other
/// processes may read meanwhile if the file system supports locks, see StoreConnection.
///
/// Every value read is checked, column by column. If the store is damaged, every function throws an
/// InputError that names table and row.
class Store {
  public:
    /// Opens a store for reading. @throws InputError if the file does not exist or has a newer
    /// format
    static Store open(const std::string& path);
    /// Opens a store for writing, or creates it. @throws InputError as open(); RunError if another
    /// process writes to the store, or the file cannot be written
    static Store open_to_write(const std::string& path);
    ~Store();
    Store(Store&&) noexcept;
    Store& operator=(Store&&) noexcept;

    /// Text of a property of the study, such as "version", "scenario" or "created"; empty if the
    /// store does not have the property.
    std::string property(const std::string& key) const;
    /// Value of a property of the study that is stored as JSON; an empty Value if the store does
    /// not have the property.
    Value document(const std::string& key) const;
    void set_property(const std::string& key, const std::string& value);

    /// Points of the study in the order of their numbers.
    std::vector<StoredPoint> points() const;
    /// Sets the points of the study: adds new points, and renumbers stored points. `points` must
    /// include every stored point.
    void set_points(const std::vector<StoredPoint>& points);

    /// Runs of the study in order of point and replication, without their metrics.
    std::vector<StoredRun> runs() const;
    /// Stores a run of the study, in place of a failed run with an equal id, if any.
    void record(const StoredRun& run);

    /// Names of the metrics of stored runs, in the order of first occurrence.
    std::vector<std::string> metric_names() const;
    /// Values of one metric in the finished runs (of one point, if given), in order of point and
    /// replication.
    std::vector<StoredValue> values(const std::string& metric,
                                    std::optional<std::uint32_t> point = {}) const;
    /// Visits the metrics of all finished runs, in order of point, replication and name of the
    /// metric.
    void for_each_value(
        const std::function<void(const StoredValue&, const std::string& metric)>& visit) const;

    /// Executes an SQL query. Calls `row` first with the column names, then with each result row.
    /// NULL is passed as an empty text.
    /// @throws std::invalid_argument with SQLite's message if the query is invalid or would write
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
