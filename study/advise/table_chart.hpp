// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/study_chart.hpp"

#include <string>

namespace rovernet {

/// Chart of the rows of a CSV file, such as results that were measured elsewhere. `x`, `y`, `by`
/// and the keys of `where` are names of columns. The ends of the interval of y are in the columns
/// "Y low" and "Y high", if the table has these columns. Rows without y are left out.
/// @param question  request of lines or bars; the table has its numbers already, so that
/// confidence,
///                  interval, quantile, common and beside are not used
/// @throws InputError if the file cannot be read or lacks a column, or if y is no number;
///         std::invalid_argument if another kind of chart is asked for, or if no row is left
Chart table_chart(const std::string& path, const ChartQuestion& question);

}  // namespace rovernet
