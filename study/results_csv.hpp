// SPDX-License-Identifier: MIT
#pragma once

#include "study/results.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// Function that writes the next piece of a text.
using Write = std::function<void(std::string_view)>;

/// Writes results as comma-separated values (RFC 4180) with a header line. Each row is a finished
/// run and metric, sorted by point, replication and metric. Columns: point, varied keys,
/// replication, metric, value (empty if undefined). All metrics are written if the query names
/// none. Equal results give equal bytes.
///
/// With `group_by`, each line is a row of answers(), a metric and a replication instead. Columns:
/// the group_by keys, replication, metric, value.
/// @throws std::invalid_argument as answers()
void write_csv(const Store& store, const Question& question, const Write& write);

/// Writes one line for each run, including failed runs: point, replication, id, fingerprint, times
/// and host.
void write_provenance_csv(const Store& store, const std::vector<Condition>& where,
                          const Write& write);

}  // namespace rovernet
