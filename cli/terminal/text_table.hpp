// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace rovernet::cli {

/// Table of text; each column is as wide as its widest cell.
class TextTable {
  public:
    using Line = std::vector<std::string>;

    explicit TextTable(Line head) : lines_{std::move(head)} {}
    /// Adds a row. @throws std::invalid_argument if row and head differ in their number of cells
    void add(Line line);
    /// Text of the table: one line for each row, without trailing blanks.
    std::string text() const;

  private:
    std::vector<Line> lines_;
};

}  // namespace rovernet::cli
