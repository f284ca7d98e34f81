// SPDX-License-Identifier: MIT
#pragma once

#include "test/models/vectors.hpp"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace rovernet::test {

/// Numbers in a table cell, separated by blanks.
inline std::vector<double> listed_numbers(const std::string& cell) {
    std::vector<double> numbers;
    std::istringstream in(cell);
    for (std::string word; in >> word;) numbers.push_back(std::stod(word));
    return numbers;
}

inline bool is_close(double value, double expected, double relative) {
    return std::abs(value - expected) <= relative * std::abs(expected);
}

}  // namespace rovernet::test
