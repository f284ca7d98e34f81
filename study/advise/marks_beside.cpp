// SPDX-License-Identifier: MIT
#include "study/advise/marks_beside.hpp"

#include "scenario/document/quantity.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace rovernet {
namespace {

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

std::optional<Numbers> numbers_of(const std::vector<std::string>& texts, const std::string& key) {
    Numbers numbers;
    bool same_unit = true;
    for (const std::string& text : texts) {
        std::string unit;
        const auto number = leading_number(text, unit);
        if (!number) return std::nullopt;
        same_unit = same_unit && (numbers.values.empty() || unit == numbers.unit);
        numbers.values.push_back(*number);
        numbers.unit = unit;
    }
    if (same_unit) return numbers;
    const auto dimension = shared_dimension(texts);
    if (!dimension) return std::nullopt;
    numbers.unit = base_unit(*dimension);
    for (std::size_t i = 0; i < texts.size(); ++i)
        numbers.values[i] = read_quantity(Value(texts[i]), key, *dimension);
    return numbers;
}

std::optional<double> number_in(const CsvTable& table, std::size_t row, const std::string& column,
                                const std::string& unit) {
    const std::string text = table.text(row, column);
    if (text.empty()) return std::nullopt;
    std::string found;
    const auto value = leading_number(text, found);
    if (value && found == unit) return value;
    table.fail(row, column,
               unit.empty() ? "a number" : fmt::format("a number and the unit {}", unit));
}

std::optional<ChartPoint> point_of(const CsvTable& table, std::size_t row, const std::string& y) {
    const auto value = number_in(table, row, y, "");
    if (!value) return std::nullopt;
    ChartPoint point{.y = *value};
    const std::string low = y + " low", high = y + " high";
    if (table.has(low)) point.low = number_in(table, row, low, "");
    if (table.has(high)) point.high = number_in(table, row, high, "");
    return point;
}

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
            table.fail(row, columns.by,
                       fmt::format("one of the curves {}", fmt::join(curves, ", ")));
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
