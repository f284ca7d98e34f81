// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <string>

namespace rovernet {

/// Shell command that simulates one run of a study's store again and writes the run's files.
std::string run_command(const Store& store, const StoredPoint& point, std::uint32_t replication);

/// Run in a study's store, and the point of the study to which the run belongs.
struct FoundRun {
    StoredRun run;  ///< run of the store, with its metrics
    StoredPoint point;
};

/// Finds a run by `name`: the first characters of its id, or POINT/REPLICATION.
/// @throws std::invalid_argument if no run or several runs match `name`
FoundRun find_run(const Store& store, const std::string& name);

}  // namespace rovernet
