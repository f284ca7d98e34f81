// SPDX-License-Identifier: MIT
#pragma once

#include "study/sweep.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Tasks of one job array, at most: Slurm's MaxArraySize, 1001 unless the cluster says otherwise,
/// is above every task's number.
inline constexpr std::uint64_t longest_array = 1000;

/// The size of chunk, no smaller than `wanted`, with which so many runs fit into one job array.
std::uint64_t chunk_for_array(std::uint64_t runs, std::uint64_t wanted);

/// The chunks of so many runs each in which a run is not finished, ascending.
/// @param size  > 0
std::vector<std::uint64_t> open_chunks(std::span<const RunState> runs, std::uint64_t size);

/// "0-3,7,9-10": numbers in ascending order, as sbatch --array takes them.
std::string array_ranges(std::span<const std::uint64_t> numbers);

/// A sweep on a Slurm cluster: a job array, each task of which makes one chunk of the runs and
/// keeps them in a store of its own, a shard; and a job behind it that merges the shards, whatever
/// became of the tasks. Nothing is asked of Slurm but to run them: what is done is in the store.
///
/// All that belongs to it but the store is in the folder STORE.slurm: job.sh, merge.sh, shards/
/// and logs/. Its texts are right for any file name without a line break.
struct SlurmSweep {
    std::string command;      ///< absolute path of rovernet
    std::string directory;    ///< folder where relative paths among the options begin: absolute
    std::string file, store;  ///< files of the study: absolute
    std::vector<std::string> options;   ///< words of the command behind FILE
    std::uint64_t chunk;                ///< runs of a task, > 0
    std::vector<std::uint64_t> chunks;  ///< chunks with runs to make; a task has its chunk's number
    std::size_t workers = 0;            ///< tasks at once; 0: as many as Slurm gives
    std::vector<std::string> sbatch = {};  ///< more words for sbatch, for both jobs

    std::string folder() const { return store + ".slurm"; }
    std::string job_file() const { return folder() + "/job.sh"; }
    std::string merge_file() const { return folder() + "/merge.sh"; }

    /// Script of a task, for bash, with SLURM_ARRAY_TASK_ID set.
    std::string job_script() const;
    /// Script of the job behind the tasks; a person may call it as well.
    std::string merge_script() const;

    /// The command that submits the tasks and prints the job's number.
    std::vector<std::string> submit_job() const;
    /// The command that submits the merge of what the job has made.
    std::vector<std::string> submit_merge(const std::string& job) const;
};

}  // namespace rovernet
