// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace rovernet {

/// Copies runs of the points that both stores have: runs that `to` lacks, or that failed in `to`
/// and finished in `from`.
/// @param below  copy only replications below this number
void copy_runs(const Store& from, Store& to,
               std::uint32_t below = std::numeric_limits<std::uint32_t>::max());

/// Copies runs from the store at `path` (of the same study) that are missing or failed in `store`.
/// @throws InputError if the file is no store, or belongs to a different version or study
void merge(Store& store, const std::string& path);

/// Checks the path of a shard (store of a part of a study's runs). @throws InputError if a file
/// exists there that is not a store. A missing file is accepted, and an empty file, too, which a
/// killed process may leave
void check_shard(const std::string& path);

/// Copies the runs of a shard (part store) like merge(), once no process writes to it; removes it.
/// @throws InputError as merge(); RunError if a process writes to the shard. After an exception the
/// shard still exists
void merge_and_remove(Store& store, const std::string& path);

}  // namespace rovernet
