// SPDX-License-Identifier: MIT
#pragma once

#include "study/results.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// Function that writes the next part of a file.
using Write = std::function<void(std::string_view)>;

/// Writes results as comma-separated values (RFC 4180) with a header line. Each line has one metric
/// of one finished run. Lines are sorted by point, replication and metric. Columns: point, varied
/// keys, replication, metric, value (empty if undefined). If the query names no metrics, all
/// metrics are written. Equal results give identical bytes.
///
/// If Question::group_by is given, each line has one metric in one replication of a row of
/// answers(). Columns: the group_by keys, replication, metric, value.
/// @throws std::invalid_argument as answers()
void write_csv(const Store& store, const Question& question, const Write& write);

/// Writes comma-separated values with one line for each run, including failed runs. Columns: point,
/// varied keys, replication, id, fingerprint, error, times and host.
void write_provenance_csv(const Store& store, const std::vector<Condition>& where,
                          const Write& write);

}  // namespace rovernet
