// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// Submits the unfinished runs of a study to Slurm, and prints the job numbers. With --dry-run the
/// scripts are only written, and printed with the commands that submit them.
/// @throws RunError if sbatch is missing or rejects a job; and as open_store()
void submit_sweep(const SweepArguments& arguments, Study& study, const std::string& store);

/// Moves the runs of shards (stores of parts of a study) into the store of the study. A shard that
/// cannot be merged is reported, and the other shards are merged.
/// @throws CommandEnd if some runs are still unfinished afterwards
void merge_shards(const SweepArguments& arguments, const Study& study, Store& store);

}  // namespace rovernet::cli
