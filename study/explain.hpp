// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <string>

namespace rovernet {

/// The command that makes one run of a store again, with its files.
std::string run_command(const Store& store, const StoredPoint& point, std::uint32_t replication);

/// A run of a store with its point.
struct FoundRun {
    StoredRun run;  ///< run with its metrics
    StoredPoint point;
};

/// The run that `name` means: the beginning of its id, or POINT/REPLICATION.
/// @throws std::invalid_argument if there is none, or more than one
FoundRun find_run(const Store& store, const std::string& name);

}  // namespace rovernet
