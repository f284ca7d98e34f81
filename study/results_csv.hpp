// SPDX-License-Identifier: MIT
#pragma once

#include "study/results.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// Gets a text piece by piece.
using Write = std::function<void(std::string_view)>;

/// The results as comma-separated values (RFC 4180) with a head: a row per finished run and metric,
/// sorted by point, replication and metric: point, the varied keys, replication, metric, value
/// (empty if undefined); of every metric if the question names none. The same bytes for the same
/// results.
///
/// With `group_by` a row per row of answers(), metric and replication instead: the keys,
/// replication, metric, value.
/// @throws std::invalid_argument as answers()
void write_csv(const Store& store, const Question& question, const Write& write);

/// A row per run, failed ones too: its point, replication, id, fingerprint, times and host.
void write_provenance_csv(const Store& store, const std::vector<Condition>& where,
                          const Write& write);

}  // namespace rovernet
