// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <string>

namespace rovernet {

/// Shell command that simulates one run of a study's store again and writes the run's files.
std::string run_command(const Store& store, const StoredPoint& point, std::uint32_t replication);

/// Run of a study's store, with its point.
struct FoundRun {
    StoredRun run;  ///< run of the store, with its metrics
    StoredPoint point;
};

/// Finds a run by `name`: the first characters of its id, or POINT/REPLICATION.
/// @throws std::invalid_argument if no run or several runs match
FoundRun find_run(const Store& store, const std::string& name);

}  // namespace rovernet
