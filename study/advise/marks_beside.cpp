// SPDX-License-Identifier: MIT
#include "study/advise/marks_beside.hpp"

#include "study/advise/table_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace rovernet {
namespace {

std::vector<std::string> names_of(const Chart& chart) {
    std::vector<std::string> names;
    for (const ChartSeries& series : chart.series) names.push_back(series.name);
    return names;
}

}  // namespace

void add_marks(Chart& chart, const std::string& path, const MarkColumns& columns) {
    const CsvTable table(path);
    std::filesystem::path file = std::filesystem::path(path).filename();
    if (file.extension() == ".csv") file.replace_extension();
    const std::vector<std::string> curves = names_of(chart);
    std::vector<ChartSeries> marks(curves.size());
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string name = columns.by.empty() ? "" : table.text(row, columns.by);
        const auto found = std::find(curves.begin(), curves.end(), name);
        if (found == curves.end()) {
            table.fail(
                row, columns.by,
                fmt::format("the name of a curve of the chart ({})", fmt::join(curves, ", ")));
        }
        const auto x = number_in(table, row, columns.x, columns.unit);
        auto point = point_of(table, row, columns.y);
        if (!x || !point) continue;
        point->x = *x;
        const auto curve = static_cast<std::size_t>(found - curves.begin());
        marks[curve].name = fmt::format("{}{}{}", name, name.empty() ? "" : ", ", file.string());
        marks[curve].beside = curve;
        marks[curve].points.push_back(*std::move(point));
    }
    for (ChartSeries& series : marks) {
        if (series.beside) chart.series.push_back(std::move(series));
    }
}

}  // namespace rovernet
