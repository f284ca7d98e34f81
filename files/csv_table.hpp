// SPDX-License-Identifier: MIT
#pragma once

#include "files/word.hpp"
#include "sim/error.hpp"

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Fields of a line of a CSV file, without the blanks around each field, with their columns. A
/// quote is a character like others.
std::vector<Word> csv_fields(std::string_view line);

/// Table of a CSV file. The first line names the columns. Empty lines, and lines that begin with #,
/// are ignored.
class CsvTable {
  public:
    /// @throws InputError if the file cannot be read or has no line of names, or if a line has
    ///         another number of fields than the line of names
    explicit CsvTable(const std::string& path);
    CsvTable(const CsvTable&) = delete;  // fields refer to lines of this object
    CsvTable& operator=(const CsvTable&) = delete;

    /// Number of rows, without the line of names.
    std::size_t size() const { return rows_.size(); }
    /// Whether the table has a column of this name.
    bool has(std::string_view column) const;
    /// Field in a row (index from 0). @throws InputError if there is no such column
    Word word(std::size_t row, std::string_view column) const;
    /// Text of a field in a row (index from 0). @throws InputError if there is no such column
    std::string text(std::size_t row, std::string_view column) const {
        return std::string(word(row, column).text);
    }
    /// Place of a row in the file.
    const Location& where(std::size_t row) const { return rows_[row].where; }
    /// @throws InputError at a field: "COLUMN: found FIELD, expected EXPECTED"
    [[noreturn]] void fail(std::size_t row, std::string_view column,
                           std::string_view expected) const;

  private:
    struct Row {
        std::vector<Word> fields;
        Location where;
    };
    std::string path_;
    std::deque<std::string> lines_;  // lines of the fields; a deque does not move them
    std::vector<std::string> names_;
    Location names_where_;  // place of the line of names
    std::vector<Row> rows_;
};

}  // namespace rovernet
