// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/study_table.hpp"
#include "study/store.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rovernet {

/// State of one run in a store.
enum class RunState { missing, failed, finished };

/// The state of each point's replications, by the point's number: of those that the study asks for,
/// and of those that are there beyond.
using Inventory = std::map<std::uint32_t, std::vector<RunState>>;

/// Number of runs of each kind.
struct RunCounts {
    std::uint64_t finished = 0;
    std::uint64_t failed = 0;
    std::uint64_t missing = 0;  ///< asked for, and neither finished nor failed
    std::uint64_t all() const { return finished + failed + missing; }
    void add(RunState state);
};

/// [study] of a store, with the options of its last sweep; all defaults if it says nothing.
/// @throws InputError if the store is damaged
StudyTable study_of(const Store& store);

/// Inventory of a store: what it has of every point. A study with `precision` asks for as many
/// replications as the values so far call for.
Inventory inventory_of(const Store& store);

RunCounts counts_of(const Inventory& inventory);

/// "unfinished: 40 of 120 runs are missing; 3 failed", or one half of it; empty if all finished.
std::string incompleteness(const RunCounts& counts);

}  // namespace rovernet
