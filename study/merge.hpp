// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"

#include <string>

namespace rovernet {

/// Copies the runs of all points that both stores have: those that `to` lacks, or that failed there
/// and are finished in `from`.
void copy_runs(const Store& from, Store& to);

/// Takes the runs of another store of the same study that are not here, or that failed here.
/// @throws InputError if it is no store, or of another version or another study
void merge(Store& store, const std::string& path);

/// @throws InputError if the path leads to something that is no store: nothing that is there may be
/// one, as an empty file may, of a process that ended early
void check_shard(const std::string& path);

/// Takes a shard's runs as merge() does, once nobody writes to it, and removes it.
/// @throws also RunError if somebody writes to it. Whatever is thrown, it stays
void merge_and_remove(Store& store, const std::string& path);

}  // namespace rovernet
