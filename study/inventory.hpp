// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"
#include "study/store.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rovernet {

/// State of one run in a store.
enum class RunState { missing, failed, finished };

/// State of the replications of each point of a study, by point number: requested replications, and
/// further replications in the store.
using Inventory = std::map<std::uint32_t, std::vector<RunState>>;

/// Number of runs in each state.
struct RunCounts {
    std::uint64_t finished = 0;
    std::uint64_t failed = 0;
    std::uint64_t missing = 0;  ///< number of requested runs that are neither finished nor failed
    std::uint64_t all() const { return finished + failed + missing; }
    void add(RunState state);
};

/// Table [study] of a study's store, with the options of its last sweep; all defaults if the store
/// has none.
/// @throws InputError if the store is damaged
StudyTable study_of(const Store& store);

/// State of every run of a study's store. With [study] precision, the number of requested
/// replications follows from the values so far.
Inventory inventory_of(const Store& store);

RunCounts counts_of(const Inventory& inventory);

/// Text on a study's missing and failed runs: "unfinished: 40 of 120 runs are missing; 3 failed",
/// or only one of these parts; empty if all runs finished.
std::string incompleteness(const RunCounts& counts);

}  // namespace rovernet
