// SPDX-License-Identifier: MIT
#include "study/advise/marks_beside.hpp"

#include "files/csv_table.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace rovernet {
namespace {

/// Number in a field in this unit; none if the field is empty.
std::optional<double> number(const CsvTable& table, std::size_t row, const std::string& column,
                             const std::string& unit) {
    const std::string text = table.text(row, column);
    if (text.empty()) return std::nullopt;
    std::string found;
    const auto value = leading_number(text, found);
    if (value && found == unit) return value;
    table.fail(row, column,
               unit.empty() ? "a number" : fmt::format("a number and the unit {}", unit));
}

std::vector<std::string> names_of(const Chart& chart) {
    std::vector<std::string> names;
    for (const ChartSeries& series : chart.series) names.push_back(series.name);
    return names;
}

}  // namespace

std::optional<double> leading_number(const std::string& text, std::string& unit) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{}) return std::nullopt;
    unit.assign(rest, end);
    unit.erase(0, unit.find_first_not_of(' '));
    return number;
}

void add_marks(Chart& chart, const std::string& path, const MarkColumns& columns) {
    const CsvTable table(path);
    std::filesystem::path file = std::filesystem::path(path).filename();
    if (file.extension() == ".csv") file.replace_extension();
    const std::vector<std::string> curves = names_of(chart);
    std::vector<ChartSeries> marks(curves.size());
    const std::string low = columns.y + " low", high = columns.y + " high";
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string name = columns.by.empty() ? "" : table.text(row, columns.by);
        const auto found = std::find(curves.begin(), curves.end(), name);
        if (found == curves.end()) {
            table.fail(row, columns.by,
                       fmt::format("one of the curves {}", fmt::join(curves, ", ")));
        }
        const auto x = number(table, row, columns.x, columns.unit);
        const auto y = number(table, row, columns.y, "");
        if (!x || !y) continue;
        ChartPoint point{.x = *x, .y = *y};
        if (table.has(low)) point.low = number(table, row, low, "");
        if (table.has(high)) point.high = number(table, row, high, "");
        const auto curve = static_cast<std::size_t>(found - curves.begin());
        marks[curve].name = fmt::format("{}{}{}", name, name.empty() ? "" : ", ", file.string());
        marks[curve].beside = curve;
        marks[curve].points.push_back(std::move(point));
    }
    for (ChartSeries& series : marks) {
        if (series.beside) chart.series.push_back(std::move(series));
    }
}

}  // namespace rovernet
