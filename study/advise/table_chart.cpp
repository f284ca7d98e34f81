// SPDX-License-Identifier: MIT
#include "study/advise/table_chart.hpp"

#include "study/advise/table_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace rovernet {
namespace {

/// Rows that meet all conditions and have a y.
std::vector<std::size_t> rows_of(const CsvTable& table, const ChartQuestion& q) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.size(); ++row) {
        const bool meets = std::all_of(q.where.begin(), q.where.end(), [&](const Condition& c) {
            return table.text(row, c.path) == c.value;
        });
        if (meets && !table.text(row, q.y).empty()) rows.push_back(row);
    }
    return rows;
}

}  // namespace

Chart table_chart(const std::string& path, const ChartQuestion& q) {
    if (q.x.empty())
        throw std::invalid_argument(
            "-x: no column is given; expected the name of a column of the table");
    const CsvTable table(path);
    const std::vector<std::size_t> rows = rows_of(table, q);
    if (rows.empty())
        throw std::invalid_argument(
            "no row of the table " + path +
            " meets the conditions of --where and has a value in the column of -y; expected other "
            "conditions, or a different column for -y");
    std::vector<std::string> places;
    for (const std::size_t row : rows) places.push_back(table.text(row, q.x));
    const auto numbers = numbers_of(places, q.x);
    const ChartKind kind = q.kind.value_or(numbers ? ChartKind::lines : ChartKind::bars);
    if (kind != ChartKind::bars && (kind != ChartKind::lines || !numbers)) {
        throw std::invalid_argument(
            kind == ChartKind::lines
                ? fmt::format("--kind: lines need numbers along the x axis, but the column {} "
                              "contains words; expected --kind bars, or a column of numbers for -x",
                              q.x)
                : "--kind: a table can be drawn only with --kind lines or --kind bars");
    }
    Chart chart{.kind = kind,
                .x_label = axis_label(q.x, numbers ? numbers->unit : ""),
                .y_label = q.y,
                .legend_title = q.by,
                .note = std::filesystem::path(path).filename().string(),
                .log_x = q.log_x,
                .log_y = q.log_y};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ChartPoint point = *point_of(table, rows[i], q.y);
        if (kind == ChartKind::lines)
            point.x = numbers->values[i];
        else
            point.category = places[i];
        series_named(chart, q.by.empty() ? "" : table.text(rows[i], q.by)).points.push_back(point);
    }
    return chart;
}

}  // namespace rovernet
