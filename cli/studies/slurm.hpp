// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// Submits what a store has not finished of a study to Slurm, and says which jobs these are. With
/// --dry-run it writes their scripts, and prints them with the commands that submit them.
/// @throws RunError if sbatch is not there or does not take a job; and as open_store()
void submit_sweep(const SweepArguments& arguments, Study& study, const std::string& store);

/// Moves the runs of shards into the store of a study. A shard that cannot be taken is named, and
/// the others are.
/// @throws CommandEnd if the store has not finished every run then
void merge_shards(const SweepArguments& arguments, const Study& study, Store& store);

}  // namespace rovernet::cli
