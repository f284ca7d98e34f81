// SPDX-License-Identifier: MIT
#pragma once

#include "files/csv_table.hpp"
#include "pictures/chart/chart.hpp"

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

/// Columns of a table of external values, such as measurements, that are drawn as marks beside the
/// curves of a study.
struct MarkColumns {
    std::string x;     ///< name of the column with x, equal to the name of the varied key
    std::string unit;  ///< unit of x in the chart; empty: none
    std::string by;    ///< name of the column with the name of the curve; empty: only one curve
    /// Name of the column with y. The ends of its interval are in "Y low" and "Y high", if the
    /// table has these columns.
    std::string y;
};

/// Number in a field of a table; none if the field is empty.
/// @param unit  unit that the field must have; empty: none
/// @throws InputError at the field
std::optional<double> number_in(const CsvTable& table, std::size_t row, const std::string& column,
                                const std::string& unit);

/// Point of a row of a table: y with its interval, which is in the columns "Y low" and "Y high", if
/// the table has these columns. None if the row has no y.
/// @throws InputError at a field that is no number
std::optional<ChartPoint> point_of(const CsvTable& table, std::size_t row, const std::string& y);

/// Adds marks for the rows of a CSV file to a chart of lines. The mark of a row is hollow, in the
/// style of the curve that the row names. The file has a line of column names, and lines of numbers
/// that are separated by commas; lines that begin with # are comments. The legend names the marks
/// by the curve and by the file, without its folders and without ".csv". Rows without y make no
/// mark.
/// @throws InputError if the file cannot be read, lacks a column, names a curve that the chart does
///         not have, or has a text where a number is expected
void add_marks(Chart& chart, const std::string& path, const MarkColumns& columns);

}  // namespace rovernet
