// SPDX-License-Identifier: MIT
#pragma once

#include "study/inventory.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Row of the results table: the points of a study that have equal values of the group_by keys.
struct Row {
    Table settings;  ///< value of each group_by key, by the path of the key
    /// Number of the study's point for each of Rows::combinations; none: excluded by the study.
    std::vector<std::optional<std::uint32_t>> points;
};

/// Rows of the results table, and the keys that vary within a row.
struct Rows {
    std::vector<std::string> averaged;  ///< varied keys over whose values a row is averaged
    /// Varied keys with one value in each row, but different values in different rows.
    std::vector<std::string> along;
    /// Combinations of values of the keys in `averaged`, in order of first use.
    std::vector<Table> combinations;
    std::vector<Row> list;  ///< rows, in the order of their first points in the study
};

/// Groups the points of a study into result rows. @param group_by  paths of varied keys
Rows rows_of(const std::vector<StoredPoint>& points, const std::vector<std::string>& group_by);

/// Number of runs that have no value in a row of the results table, by reason.
struct Gaps {
    std::uint64_t failed = 0;
    std::uint64_t undefined = 0;  ///< number of finished runs in which the metric is undefined
    std::uint64_t missing = 0;    ///< number of runs that were not made yet
    /// Text of the numbers of runs above 0: "2 failed, 1 undefined, 3 missing".
    std::string text() const;
};

/// Values of one metric, by point of the study and replication.
using ValuesOfPoints = std::map<std::uint32_t, std::vector<std::optional<double>>>;

ValuesOfPoints values_of_points(const Store& store, const std::string& metric);

/// Cells of the results table for one metric. A cell is a combination of values of the averaged
/// keys, in one replication. Corresponding cells of all rows use the same random numbers.
class Cells {
  public:
    Cells(const Rows& rows, const Inventory& inventory, ValuesOfPoints values);

    /// Mean of one row of the results table in each replication, over the row's runs with equal
    /// weights; if `common`, only over runs that have a value in every row.
    std::map<std::uint32_t, double> means(std::size_t row, bool common) const;

    Gaps gaps(std::size_t row) const;

    std::uint64_t count() const;   ///< number of cells of one row: combinations times replications
    std::uint64_t common() const;  ///< number of cells for which every row has a value

    /// Text with one line for each row that lacks a value which some other row has; empty if all
    /// rows have values in the same cells.
    std::string unbalanced() const;

  private:
    std::optional<double> value(std::size_t row, std::size_t combination, std::size_t r) const;
    std::string lack(std::size_t row) const;
    std::string_view reason(std::size_t row, std::size_t combination, std::size_t r) const;

    const Rows& rows_;
    const Inventory& inventory_;
    ValuesOfPoints values_;
    std::size_t replications_ = 0;
    std::vector<std::vector<bool>> in_every_row_;  // flag for each combination and replication
    std::vector<bool> in_any_row_;  // flag for each replication, over all combinations
};

}  // namespace rovernet
