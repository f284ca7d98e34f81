// SPDX-License-Identifier: MIT
#pragma once

#include "study/inventory.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Row of the results table: all points of a study with equal values of the keys by which results
/// are grouped (group_by).
struct Row {
    Table settings;  ///< value of each key by which the row groups points, by the path of the key
    /// Number of the row's point for each of Rows::combinations; none: the study excludes the
    /// combination.
    std::vector<std::optional<std::uint32_t>> points;
};

/// Rows of the results table, and the keys that vary within a row.
struct Rows {
    std::vector<std::string> averaged;  ///< varied keys over which each row is averaged
    /// Varied keys outside of group_by that have one value within each row, but different values in
    /// different rows.
    std::vector<std::string> along;
    /// Combinations of values of the keys in `averaged`, in the order of their first points.
    std::vector<Table> combinations;
    std::vector<Row> list;  ///< rows, in the order of their first points in the study
};

/// Groups the points of a study into result rows. @param group_by  paths of varied keys
Rows rows_of(const std::vector<StoredPoint>& points, const std::vector<std::string>& group_by);

/// Numbers of runs without a value in a row of the results table, by reason.
struct Gaps {
    std::uint64_t failed = 0;
    std::uint64_t undefined = 0;  ///< number of finished runs in which the metric is undefined
    std::uint64_t missing = 0;    ///< number of runs that were not made yet
    /// Text that lists the nonzero counts: "2 failed, 1 undefined, 3 missing".
    std::string text() const;
};

/// Values of one metric by point number. Each list has one value for each replication; none: the
/// run has no value.
using ValuesOfPoints = std::map<std::uint32_t, std::vector<std::optional<double>>>;

/// Values of a metric, or of the quotient "A/B" of two metrics, run by run. A quotient by 0, or of
/// a metric without a value, has none.
ValuesOfPoints values_of_points(const Store& store, const std::string& metric);

/// Cells of the results table for one metric. A cell is a combination of values of the averaged
/// keys, in one replication. Corresponding cells of all rows use the same random numbers.
class Cells {
  public:
    Cells(const Rows& rows, const Inventory& inventory, ValuesOfPoints values);

    /// Means of one row of the results table, by replication number. Each mean is over the row's
    /// cells (combinations of averaged values) in that replication, with equal weights. If
    /// `common`, only cells for which every row has a value are included. @param row  index of the
    /// row
    std::map<std::uint32_t, double> means(std::size_t row, bool common) const;

    Gaps gaps(std::size_t row) const;

    std::uint64_t count() const;   ///< number of cells of one row: combinations times replications
    std::uint64_t common() const;  ///< number of cells for which every row has a value

    /// Text that lists, line by line, the rows without a value in a cell in which a different row
    /// has a value; empty if all rows have values in equal cells.
    std::string unbalanced() const;

  private:
    std::optional<double> value(std::size_t row, std::size_t combination, std::size_t r) const;
    std::string lack(std::size_t row) const;
    std::string_view reason(std::size_t row, std::size_t combination, std::size_t r) const;

    const Rows& rows_;
    const Inventory& inventory_;
    ValuesOfPoints values_;
    std::size_t replications_ = 0;
    // Flag of each cell, by combination and replication; true: every row has a value.
    std::vector<std::vector<bool>> in_every_row_;
    // Flag of each replication; true: at least one row has a value for at least one combination.
    std::vector<bool> in_any_row_;
};

}  // namespace rovernet
