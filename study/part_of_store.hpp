// SPDX-License-Identifier: MIT
#pragma once

#include "study/store.hpp"
#include "study/study.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rovernet {

/// Whether a study covers only a part of the store at `path`. True if study and store share a
/// point, and the store has further points or more replications. False if the file does not exist,
/// or if its runs are of a different code version.
bool takes_part_of(const std::string& path, const Study& study);

/// Number of replications in a store at the points (parameter combinations) of a study. None if it
/// is not larger than the study's number of replications, or if the study has a `precision`.
std::optional<std::uint32_t> more_replications(const Store& store, const Study& study);

/// Copies the runs that the study requests from the store `whole` into the store `part`.
void take_part(const Store& whole, const Study& study, Store& part);

/// Adds the points and runs of the store `part` to the store `whole`. If only one store varies a
/// key, the points of the other store get a value of this key: the value at a point that both
/// stores have.
void give_back(const Store& part, Store& whole);

}  // namespace rovernet
