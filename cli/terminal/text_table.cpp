// SPDX-License-Identifier: MIT
#include "cli/terminal/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet::cli {

void TextTable::add(Line line) {
    if (line.size() != lines_.front().size()) {
        throw std::invalid_argument("TextTable: a line has a different number of cells");
    }
    lines_.push_back(std::move(line));
}

std::string TextTable::text() const {
    std::vector<std::size_t> widths(lines_.front().size());
    for (const Line& line : lines_) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            widths[i] = std::max(widths[i], line[i].size());
        }
    }
    std::string text;
    for (const Line& line : lines_) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            text += fmt::format("{:<{}}  ", line[i], widths[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

}  // namespace rovernet::cli
