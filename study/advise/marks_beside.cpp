// SPDX-License-Identifier: MIT
#include "study/advise/marks_beside.hpp"

#include "files/input_file.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace rovernet {
namespace {

constexpr std::size_t most_bytes = 10'000'000;  // of a table

/// The text before the next `end`, which is taken off the front with it.
std::string cut(std::string_view& text, char end) {
    const std::string_view piece = text.substr(0, text.find(end));
    text.remove_prefix(std::min(piece.size() + 1, text.size()));
    return std::string(piece);
}

/// Rows of a CSV file, with the place of each.
class MarkTable {
  public:
    explicit MarkTable(const std::string& path) : path_(path) {
        const std::string bytes = InputFile(path).read(most_bytes);
        std::string_view rest = bytes;
        for (int number = 1; !rest.empty(); ++number) {
            std::string line = cut(rest, '\n');
            if (line.ends_with('\r')) line.pop_back();
            if (line.empty() || line.front() == '#') continue;
            add(fields_of(line), number);
        }
        if (head_.empty()) fail(0, "no line of column names");
    }

    std::size_t size() const { return rows_.size(); }

    /// Whether the table has a column.
    bool has(const std::string& column) const {
        return std::find(head_.begin(), head_.end(), column) != head_.end();
    }
    const std::string& text(std::size_t row, const std::string& column) const {
        const auto found = std::find(head_.begin(), head_.end(), column);
        if (found != head_.end())
            return rows_[row][static_cast<std::size_t>(found - head_.begin())];
        const std::string near = did_you_mean(column, head_);
        fail(0, fmt::format("no column \"{}\"; expected one in {}{}{}", column,
                            fmt::join(head_, ", "), near.empty() ? "" : "; ", near));
    }
    /// Number of a field in this unit; none if the field is empty.
    std::optional<double> number(std::size_t row, const std::string& column,
                                 const std::string& unit) const {
        const std::string& field = text(row, column);
        if (field.empty()) return std::nullopt;
        std::string found;
        const auto value = leading_number(field, found);
        if (value && found == unit) return value;
        fail(lines_[row], fmt::format("{}: found \"{}\", expected a number{}{}", column, field,
                                      unit.empty() ? "" : " and the unit ", unit));
    }
    [[noreturn]] void fail_at(std::size_t row, const std::string& what) const {
        fail(lines_[row], what);
    }

  private:
    static std::vector<std::string> fields_of(std::string_view line) {
        const auto commas = std::count(line.begin(), line.end(), ',');
        std::vector<std::string> fields;
        for (auto i = commas; i >= 0; --i) fields.push_back(cut(line, ','));
        return fields;
    }
    void add(std::vector<std::string> fields, int number) {
        if (head_.empty()) {
            head_ = std::move(fields);
            return;
        }
        if (fields.size() != head_.size()) {
            fail(number, fmt::format("found {} fields, expected {}", fields.size(), head_.size()));
        }
        rows_.push_back(std::move(fields));
        lines_.push_back(number);
    }
    [[noreturn]] void fail(int line, const std::string& what) const {
        throw InputError({.source = path_, .line = line, .column = line > 0 ? 1 : 0}, what);
    }

    std::string path_;
    std::vector<std::string> head_ = {};
    std::vector<std::vector<std::string>> rows_ = {};
    std::vector<int> lines_ = {};
};

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
    const MarkTable table(path);
    std::filesystem::path file = std::filesystem::path(path).filename();
    if (file.extension() == ".csv") file.replace_extension();
    const std::vector<std::string> curves = names_of(chart);
    std::vector<ChartSeries> marks(curves.size());
    const std::string low = columns.y + " low", high = columns.y + " high";
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string name = columns.by.empty() ? "" : table.text(row, columns.by);
        const auto found = std::find(curves.begin(), curves.end(), name);
        if (found == curves.end()) {
            table.fail_at(row, fmt::format("{}: found \"{}\", expected one of the curves {}",
                                           columns.by, name, fmt::join(curves, ", ")));
        }
        const auto x = table.number(row, columns.x, columns.unit);
        const auto y = table.number(row, columns.y, "");
        if (!x || !y) continue;
        ChartPoint point{.x = *x, .y = *y};
        if (table.has(low)) point.low = table.number(row, low, "");
        if (table.has(high)) point.high = table.number(row, high, "");
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
