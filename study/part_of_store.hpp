// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"
#include "study/study.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rovernet {

/// Whether a study covers only a part of a store: both share a point, and the store has further
/// points or more replications. False if the file does not exist or has a different version.
bool takes_part_of(const std::string& path, const Study& study);

/// Number of the last replication in a store that exceeds the study's replications; none if there
/// is no such replication, or if the study has a `precision`.
std::optional<std::uint32_t> more_replications(const Store& store, const Study& study);

/// Copies the runs of the study from the whole store into the store `part`.
void take_part(const Store& whole, const Study& study, Store& part);

/// Adds points and runs of `part` back to the whole store. A key that only one of the two stores
/// varies gets, in the other store, its value at a common point.
void give_back(const Store& part, Store& whole);

}  // namespace rovernet
