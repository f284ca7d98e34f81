// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/compare.hpp"
#include "study/store.hpp"

#include <string>
#include <vector>

namespace rovernet::cli {

/// Form in which results are printed.
enum class ReportForm { text, csv, json };

/// Prints the comparisons of a study, one comparison for each metric. As JSON, a single comparison
/// is printed as an object; several comparisons are printed as an object with a list.
void print_comparisons(const std::vector<Comparison>& all, ReportForm form);

/// Writes the picture of a comparison. For protocols the picture shows the delivery ratio over the
/// airtime for each delivered byte. For models it shows the metric, and the errors over the costs.
/// @param store  store of the compared runs
void write_comparison(const std::string& file, const Comparison& comparison, const Store& store);

}  // namespace rovernet::cli
