// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/compare.hpp"
#include "study/store.hpp"

#include <string>
#include <vector>

namespace rovernet::cli {

/// Form in which results are printed.
enum class ReportForm { text, csv, json };

/// Prints comparisons of the same models or values, one for each metric. As JSON, one comparison is
/// a document of its own, and several are a list.
void print_comparisons(const std::vector<Comparison>& all, ReportForm form);

/// Writes the picture of a comparison: of protocols the delivery ratio over the airtime for each
/// byte delivered; else the metric, and errors over costs.
/// @param store  store of the compared runs
void write_comparison(const std::string& file, const Comparison& comparison, const Store& store);

}  // namespace rovernet::cli
