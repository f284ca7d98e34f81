// SPDX-License-Identifier: MIT
#pragma once

#include "files/csv_table.hpp"
#include "pictures/chart/chart.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Number at the beginning of a text such as "30 s"; none if there is no number.
/// @param unit  receives the text behind the number, without leading blanks
std::optional<double> leading_number(const std::string& text, std::string& unit);

/// Numbers of texts such as "30 s", with their common unit.
struct Numbers {
    std::vector<double> values;
    std::string unit;  ///< empty: none
};

/// Numbers of texts: as they stand if they share their unit, otherwise in the base unit of their
/// quantity; none if a text is no number, or if the units do not fit together.
/// @param key  name of the texts' key or column, for error messages
std::optional<Numbers> numbers_of(const std::vector<std::string>& texts, const std::string& key);

/// Number in a field of a table; none if the field is empty.
/// @param unit  unit that the field must have; empty: none
/// @throws InputError at the field
std::optional<double> number_in(const CsvTable& table, std::size_t row, const std::string& column,
                                const std::string& unit);

/// Point of a row of a table: y with its interval, which is in the columns "Y low" and "Y high", if
/// the table has these columns. None if the row has no y.
/// @throws InputError at a field that is no number
std::optional<ChartPoint> point_of(const CsvTable& table, std::size_t row, const std::string& y);

}  // namespace rovernet
