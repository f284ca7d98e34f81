// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"

#include <string>

namespace rovernet {

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

/// Adds marks for the rows of a CSV file to a chart of lines. The mark of a row is hollow, in the
/// style of the curve that the row names. The file has a line of column names, and lines of numbers
/// that are separated by commas; lines that begin with # are comments. The legend names the marks
/// by the curve and by the file, without its folders and without ".csv". Rows without y make no
/// mark.
/// @throws InputError if the file cannot be read, lacks a column, names a curve that the chart does
///         not have, or has a text where a number is expected
void add_marks(Chart& chart, const std::string& path, const MarkColumns& columns);

}  // namespace rovernet
