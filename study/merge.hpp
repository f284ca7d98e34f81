// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace rovernet {

/// Copies runs of those parameter combinations (points of a study) that both stores have. A run is
/// copied if it is missing in `to`, or if it failed in `to` and finished in `from`.
/// @param below  copies only replications below this number
void copy_runs(const Store& from, Store& to,
               std::uint32_t below = std::numeric_limits<std::uint32_t>::max());

/// Copies runs that are missing or failed in `store` from the store at `path`, which must be of the
/// same study.
/// @throws InputError if the file is no store, or belongs to a different version or study
void merge(Store& store, const std::string& path);

/// Checks the path of a shard (store of a part of a study's runs). A missing file is accepted. An
/// empty file is accepted, too, since a killed process may leave one.
/// @throws InputError if the path exists but is not a store
void check_shard(const std::string& path);

/// Copies the runs of a shard (store of a part of a study's runs) like merge(), then removes the
/// shard.
/// @throws InputError as merge(); RunError if a process writes to the shard. After an exception the
/// shard still exists
void merge_and_remove(Store& store, const std::string& path);

}  // namespace rovernet
