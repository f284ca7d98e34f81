// SPDX-License-Identifier: MIT
#include "files/csv_table.hpp"

#include "files/text_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rovernet {

std::vector<Word> csv_fields(std::string_view line) {
    std::vector<Word> out;
    for (std::size_t begin = 0;;) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        std::size_t first = begin, last = end;
        while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
        while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
        out.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
        if (end == line.size()) return out;
        begin = end + 1;
    }
}

CsvTable::CsvTable(const std::string& path) : path_(path) {
    TextLines lines{TextSource(path)};
    while (const auto line = lines.next()) {
        if (line->empty() || line->front() == '#') continue;
        const std::vector<Word> fields = csv_fields(lines_.emplace_back(*line));
        if (names_.empty()) {
            for (const Word& each : fields) names_.emplace_back(each.text);
            names_where_ = lines.where();
            continue;
        }
        if (fields.size() != names_.size()) {
            throw InputError(
                lines.where(),
                fmt::format(
                    "found {} fields; expected {}, as in the line with the names of the columns",
                    fields.size(), names_.size()));
        }
        rows_.push_back({fields, lines.where()});
    }
    if (names_.empty())
        throw InputError({path_, 0, 0},
                         "the file has no line with the names of the columns; expected this line "
                         "before all other lines");
}

bool CsvTable::has(std::string_view column) const {
    return std::find(names_.begin(), names_.end(), column) != names_.end();
}

Word CsvTable::word(std::size_t row, std::string_view column) const {
    const auto found = std::find(names_.begin(), names_.end(), column);
    if (found == names_.end()) {
        const std::string near = did_you_mean(std::string(column), names_);
        throw InputError(names_where_,
                         fmt::format("no column \"{}\"; expected one of {}{}{}", column,
                                     fmt::join(names_, ", "), near.empty() ? "" : "; ", near));
    }
    return rows_[row].fields[static_cast<std::size_t>(found - names_.begin())];
}

void CsvTable::fail(std::size_t row, std::string_view column, std::string_view expected) const {
    constexpr std::size_t longest = 40;
    const Word field = word(row, column);
    Location place = where(row);
    place.column = field.column;
    throw InputError(place, fmt::format("{}: found \"{}\", expected {}", column,
                                        printable(field.text, longest), expected));
}

}  // namespace rovernet
