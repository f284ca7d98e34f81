// SPDX-License-Identifier: MIT
#pragma once

#include "study/inventory.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A row of a table of results: the points that agree in the keys that it is grouped by.
struct Row {
    Table settings;  ///< path -> value, of those keys
    std::vector<std::optional<std::uint32_t>>
        points;  ///< points by combination; none where excluded
};

/// The rows of a table, and what differs between the points of one row.
struct Rows {
    std::vector<std::string> averaged;  ///< keys with several values in a row
    std::vector<std::string> along;     ///< keys with one value in each row, not in all the same
    std::vector<Table>
        combinations;       ///< combinations of the averaged keys' values, in order of use
    std::vector<Row> list;  ///< rows, in the order of their first points
};

/// @param group_by  paths that vary
Rows rows_of(const std::vector<StoredPoint>& points, const std::vector<std::string>& group_by);

/// Runs of a row that are missing from its value.
struct Gaps {
    std::uint64_t failed = 0;
    std::uint64_t undefined = 0;  ///< finished, without a value of the metric
    std::uint64_t missing = 0;    ///< asked for, and not made
    /// "2 failed, 1 undefined, 3 missing", of those above 0.
    std::string text() const;
};

/// The values of one metric, by point and replication.
using ValuesOfPoints = std::map<std::uint32_t, std::vector<std::optional<double>>>;

ValuesOfPoints values_of_points(const Store& store, const std::string& metric);

/// The cells of a table of one metric. A cell is a combination of the averaged keys' values in one
/// replication: the same place, and the same random numbers, in every row.
class Cells {
  public:
    Cells(const Rows& rows, const Inventory& inventory, ValuesOfPoints values);

    /// Mean of each replication over the cells of a row, each with the same weight; if `common`,
    /// over those cells only that every row has.
    std::map<std::uint32_t, double> means(std::size_t row, bool common) const;

    Gaps gaps(std::size_t row) const;

    std::uint64_t count() const;   ///< cells of one row
    std::uint64_t common() const;  ///< cells that every row has

    /// Text that names the rows without some cell that another row has, a line each; empty if every
    /// row has the same cells.
    std::string unbalanced() const;

  private:
    std::optional<double> value(std::size_t row, std::size_t combination, std::size_t r) const;
    std::string lack(std::size_t row) const;
    std::string_view reason(std::size_t row, std::size_t combination, std::size_t r) const;

    const Rows& rows_;
    const Inventory& inventory_;
    ValuesOfPoints values_;
    std::size_t replications_ = 0;
    std::vector<std::vector<bool>> in_every_row_;  // flags by combination and replication
    std::vector<bool> in_any_row_;                 // flags by replication, in any combination
};

}  // namespace rovernet
