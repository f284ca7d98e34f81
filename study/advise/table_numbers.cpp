// SPDX-License-Identifier: MIT
#include "study/advise/table_numbers.hpp"

#include "scenario/document/quantity.hpp"

#include <fmt/format.h>

#include <charconv>

namespace rovernet {

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

}  // namespace rovernet
