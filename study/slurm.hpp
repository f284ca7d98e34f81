// SPDX-License-Identifier: MIT
#pragma once

#include "study/sweep.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Largest number of tasks of one job array. Task numbers must be below Slurm's MaxArraySize, which
/// is 1001 by default.
inline constexpr std::uint64_t longest_array = 1000;

/// Number of runs in a chunk (the runs of one task of a job array). The result is `wanted`, or more
/// if all runs would not fit one array of longest_array tasks.
std::uint64_t chunk_for_array(std::uint64_t runs, std::uint64_t wanted);

/// Numbers of the chunks (runs of one task of a job array) that have unfinished runs, in ascending
/// order.
/// @param runs  states of all runs in the order of run_states()
/// @param size  number of runs of a chunk, > 0
std::vector<std::uint64_t> open_chunks(std::span<const RunState> runs, std::uint64_t size);

/// Task numbers as a text for sbatch --array: "0-3,7,9-10". @param numbers  ascending
std::string array_ranges(std::span<const std::uint64_t> numbers);

/// Sweep (all runs of a study) on a Slurm cluster. Each task of a job array makes one chunk of the
/// runs and writes a separate store, a shard. A second job merges the shards after all tasks, even
/// if tasks failed. The store, not Slurm, determines which runs are finished.
///
/// Scripts and logs are in the folder STORE.slurm: job.sh, merge.sh, shards/ and logs/. File names
/// may contain any character except a line break.
struct SlurmSweep {
    std::string command;  ///< absolute path of the program rovernet
    /// Absolute path of the working directory, to which relative paths in `options` refer.
    std::string directory;
    std::string file, store;           ///< scenario file and store of the study: absolute paths
    std::vector<std::string> options;  ///< command-line words after FILE of `rovernet sweep FILE`
    std::uint64_t chunk;               ///< number of runs that each task makes, > 0
    /// Numbers of the chunks (groups of `chunk` runs) to make. The number of a task in the job
    /// array is the number of its chunk.
    std::vector<std::uint64_t> chunks;
    std::size_t workers = 0;               ///< largest number of simultaneous tasks; 0: no limit
    std::vector<std::string> sbatch = {};  ///< further options of sbatch, for the job array and the
                                           ///< merge job

    std::string folder() const { return store + ".slurm"; }
    std::string job_file() const { return folder() + "/job.sh"; }
    std::string merge_file() const { return folder() + "/merge.sh"; }

    /// Bash script of a task of the job array, which needs SLURM_ARRAY_TASK_ID.
    std::string job_script() const;
    /// Bash script of the job that merges the shards; a user may also run the script by hand.
    std::string merge_script() const;

    /// Words of the sbatch command that submits the job array and prints its job number.
    std::vector<std::string> submit_job() const;
    /// Words of the sbatch command that submits the job which merges the shards. The job runs when
    /// the job array has ended.
    /// @param job  number of the job array
    std::vector<std::string> submit_merge(const std::string& job) const;
};

}  // namespace rovernet
