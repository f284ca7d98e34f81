// SPDX-License-Identifier: MIT
#include "cli/studies/slurm.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "experiment/output.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "study/command_words.hpp"
#include "study/merge.hpp"
#include "study/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <sys/wait.h>

namespace rovernet::cli {
namespace {

namespace fs = std::filesystem;

/// Runs an sbatch --parsable; the number of the job that it prints. Its words go to standard error.
std::string submit(const std::vector<std::string>& command) {
    const std::string line = "exec " + shell_command(command);
    std::FILE* pipe = popen(line.c_str(), "r");
    if (!pipe)
        throw RunError(
            "cannot start the program sbatch: the operating system cannot create a process; try "
            "again later");
    char text[200] = {};
    const std::size_t size = std::fread(text, 1, sizeof text - 1, pipe);
    const int status = pclose(pipe);
    const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    if (exit == 127) {  // as a shell says it
        throw RunError(
            "the program sbatch was not found; use --executor slurm on a machine that submits jobs "
            "to Slurm; --dry-run prints the jobs without submitting them");
    }
    const std::string job =
        std::string(text, size).substr(0, std::string_view(text).find_first_not_of("0123456789"));
    if (exit != 0 || job.empty()) {
        throw RunError(fmt::format("sbatch refused the job (exit code {}); the command was: {}",
                                   exit, shell_command(command)));
    }
    return job;
}

/// The options over the file and the limits of a run, as words for the command of a task.
std::vector<std::string> task_options(const SweepArguments& a, const Study& study) {
    std::vector<std::string> words = option_words(study.options());
    if (a.timeout) words.insert(words.end(), {"--timeout", *a.timeout});
    if (a.memory) words.insert(words.end(), {"--memory", *a.memory});
    if (a.fail_fast) words.emplace_back("--fail-fast");
    return words;
}

SlurmSweep plan(const SweepArguments& a, Study& study, const std::string& store) {
    if (a.file == standard_input) {
        throw std::invalid_argument(
            "sweep -: each task of a job array reads the scenario again, which standard input does "
            "not allow; expected a scenario file");
    }
    // Closed again before a task reads it.
    const std::vector<RunState> states = run_states(study, open_store(store, study));
    SlurmSweep slurm{.command = fs::read_symlink("/proc/self/exe").string(),
                     .directory = fs::current_path().string(),
                     .file = fs::absolute(a.file).string(),
                     .store = fs::absolute(store).string(),
                     .options = task_options(a, study),
                     .chunk = chunk_for_array(states.size(), a.chunk),
                     .chunks = {},
                     .workers = a.workers};
    slurm.chunks = open_chunks(states, slurm.chunk);
    std::istringstream words(a.sbatch);
    for (std::string word; words >> word;) slurm.sbatch.push_back(word);
    if (slurm.chunk > a.chunk) {
        notice(fmt::format(
            "a chunk has {} runs, more than --chunk says, because a job array has at most {} tasks",
            slurm.chunk, longest_array));
    }
    return slurm;
}

void write_scripts(const SlurmSweep& slurm) {
    for (const char* name : {"/shards", "/logs"}) fs::create_directories(slurm.folder() + name);
    write_file(slurm.job_file(), slurm.job_script());
    write_file(slurm.merge_file(), slurm.merge_script());
}

/// Begin of every answer in JSON.
Table table_of(const SlurmSweep& slurm) {
    Table table;
    table.set("store", slurm.store);
    table.set("tasks", static_cast<std::uint64_t>(slurm.chunks.size()));
    table.set("chunk", slurm.chunk);
    return table;
}

void print_nothing(const SweepArguments& a, const SlurmSweep& slurm) {
    if (a.json) fmt::print("{}", to_json(table_of(slurm)));
    notice("every run is finished: nothing to submit");
}

void print_scripts(const SweepArguments& a, const SlurmSweep& slurm) {
    const std::string job = shell_command(slurm.submit_job());
    const std::string merge = shell_command(slurm.submit_merge("JOB"));
    if (a.json) {
        Table table = table_of(slurm);
        table.set("job_script", slurm.job_script());
        table.set("merge_script", slurm.merge_script());
        table.set("submit_job", job);
        table.set("submit_merge", merge);
        fmt::print("{}", to_json(table));
        return;
    }
    fmt::print(
        "# {}\n{}\n# {}\n{}\n# commands that submit the jobs; JOB is the number that the first "
        "command prints\n{}\n{}\n",
        slurm.job_file(), slurm.job_script(), slurm.merge_file(), slurm.merge_script(), job, merge);
}

std::string submit_merge(const SlurmSweep& slurm, const std::string& job) {
    try {
        return submit(slurm.submit_merge(job));
    } catch (const RunError& error) {
        throw RunError(fmt::format(
            "the tasks were submitted as job {}, but the job that merges the results was not "
            "submitted: {}\nwhen the job of the tasks has ended, merge the results by\n  {}",
            job, error.what(),
            shell_command(std::vector<std::string>{"bash", slurm.merge_file()})));
    }
}

void print_jobs(const SweepArguments& a, const SlurmSweep& slurm, const std::string& job,
                const std::string& merge_job) {
    if (a.json) {
        Table table = table_of(slurm);
        table.set("job", job);
        table.set("merge_job", merge_job);
        fmt::print("{}", to_json(table));
        return;
    }
    fmt::print(
        "job {}: {} tasks of up to {} runs; job {} then merges the results into {}\nthe output of "
        "the tasks is in {}/logs; when both jobs have ended, this command makes missing runs:\n  "
        "{}\n",
        job, slurm.chunks.size(), slurm.chunk, merge_job, slurm.store, slurm.folder(), a.command);
}

/// Tells what the store has of the study after a merge. @throws CommandEnd if that is not all
void report_state(const SweepArguments& a, const Study& study, const Store& store) {
    const std::vector<RunState> states = run_states(study, store);
    const auto count = [&](RunState state) {
        return static_cast<std::uint64_t>(std::count(states.begin(), states.end(), state));
    };
    const std::uint64_t finished = count(RunState::finished);
    const std::uint64_t failed = count(RunState::failed), left = count(RunState::missing);
    if (a.json) {
        Table table;
        table.set("store", store.path());
        table.set("finished", finished);
        table.set("failed", failed);
        table.set("left", left);
        fmt::print("{}", to_json(table));
    }
    const std::string end =
        fmt::format("{} runs are finished, {} failed, {} are left; results in {}", finished, failed,
                    left, store.path());
    if (failed + left > 0) throw CommandEnd(partly_failed, end);
    notice(end);
}

}  // namespace

void submit_sweep(const SweepArguments& a, Study& study, const std::string& store) {
    const SlurmSweep slurm = plan(a, study, store);
    if (slurm.chunks.empty()) return print_nothing(a, slurm);
    write_scripts(slurm);
    if (a.dry_run) return print_scripts(a, slurm);
    const HeldStop until_told;  // of the jobs, or nobody knows them
    const std::string job = submit(slurm.submit_job());
    print_jobs(a, slurm, job, submit_merge(slurm, job));
}

void merge_shards(const SweepArguments& a, const Study& study, Store& store) {
    const HeldStop until_moved;
    for (const std::string& path : a.merge) {
        if (stops_asked() > 0)
            throw CommandEnd(interrupted, "interrupted; run the same command to continue");
        try {
            merge_and_remove(store, path);
        } catch (const std::exception& error) {
            notice(fmt::format("the runs of this shard were not merged: {}", error.what()));
        }
    }
    report_state(a, study, store);
}

}  // namespace rovernet::cli
