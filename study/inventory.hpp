// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"
#include "study/store.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rovernet {

/// State of one run in a study's store: not in the store, failed or finished.
enum class RunState { missing, failed, finished };

/// States of a study's runs, by point number. Each list has one state for each replication: all
/// replications that the study requests, and further replications in the store.
using Inventory = std::map<std::uint32_t, std::vector<RunState>>;

/// Number of runs in each state.
struct RunCounts {
    std::uint64_t finished = 0;
    std::uint64_t failed = 0;
    std::uint64_t missing = 0;  ///< number of requested runs that are neither finished nor failed
    std::uint64_t all() const { return finished + failed + missing; }
    void add(RunState state);
};

/// Table [study] that the last sweep wrote into a study's store, with that sweep's options. Without
/// such a table, every value is the default.
/// @throws InputError if the store is damaged
StudyTable study_of(const Store& store);

/// State of every run of a study's store. With [study] precision, the number of requested
/// replications follows from the stored values.
Inventory inventory_of(const Store& store);

RunCounts counts_of(const Inventory& inventory);

/// Number of runs in words: "1 run", "24 runs".
std::string runs_text(std::uint64_t runs);

/// Text on a study's missing and failed runs, such as "unfinished: 40 of 120 runs are missing; 3
/// failed", or one of these two parts; empty if all runs finished.
std::string incompleteness(const RunCounts& counts);

}  // namespace rovernet
