// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// Submits the unfinished runs of a study to the batch system Slurm, and prints the job numbers.
/// With --dry-run nothing is submitted: scripts are written, and printed with the commands that
/// submit them.
/// @throws RunError if sbatch is missing or rejects a job, or if open_store() fails
void submit_sweep(const SweepArguments& arguments, Study& study, const std::string& store);

/// Moves the runs of shards (stores of parts of a study) into the store of the study. If a shard
/// cannot be merged, a notice is printed, and the other shards are merged.
/// @throws CommandEnd if some runs of the study are unfinished or failed afterwards
void merge_shards(const SweepArguments& arguments, const Study& study, Store& store);

}  // namespace rovernet::cli
