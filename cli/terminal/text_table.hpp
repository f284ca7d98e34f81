// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace rovernet::cli {

/// Columns of text, each as wide as its widest cell.
class TextTable {
  public:
    using Line = std::vector<std::string>;

    explicit TextTable(Line head) : lines_{std::move(head)} {}
    /// @throws std::invalid_argument if it has not as many cells as the head
    void add(Line line);
    /// A line each, with its newline and no blanks at its end.
    std::string text() const;

  private:
    std::vector<Line> lines_;
};

}  // namespace rovernet::cli
