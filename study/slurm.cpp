// SPDX-License-Identifier: MIT
#include "study/slurm.hpp"

#include "study/command_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace rovernet {
namespace {

/// A path in the words of sbatch, which replaces %a and the like in it.
std::string log_pattern(const std::string& path) {
    std::string text;
    for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
    return text;
}

/// Begin of a script, and the sweep that it ends in, but for its last words.
std::string head(const SlurmSweep& s) {
    return fmt::format("#!/bin/bash\ncd {} || exit\n", shell_word(s.directory));
}
std::string sweep_command(const SlurmSweep& s) {
    std::vector<std::string> words{s.command, "sweep", s.file};
    words.insert(words.end(), s.options.begin(), s.options.end());
    return "exec " + shell_command(words);
}

/// The path of a shard for a shell, in which a variable has the number of its chunk.
std::string shard_word(const SlurmSweep& s, const char* variable) {
    return fmt::format("{}\"${}\".db", shell_word(s.folder() + "/shards/"), variable);
}

std::vector<std::string> sbatch_words(const SlurmSweep& s, std::vector<std::string> own,
                                      const std::string& script) {
    const std::string name = std::filesystem::path(s.file).stem().string();
    std::vector<std::string> words{"sbatch", "--parsable", "--job-name=" + name};
    words.insert(words.end(), own.begin(), own.end());
    words.insert(words.end(), s.sbatch.begin(), s.sbatch.end());
    words.push_back(script);
    return words;
}

}  // namespace

std::uint64_t chunk_for_array(std::uint64_t runs, std::uint64_t wanted) {
    return std::max(wanted, (runs + longest_array - 1) / longest_array);
}

std::vector<std::uint64_t> open_chunks(std::span<const RunState> runs, std::uint64_t size) {
    std::vector<std::uint64_t> chunks;
    for (std::uint64_t place = 0; place < runs.size(); ++place) {
        const std::uint64_t chunk = place / size;
        const bool known = !chunks.empty() && chunks.back() == chunk;
        if (runs[place] != RunState::finished && !known) chunks.push_back(chunk);
    }
    return chunks;
}

std::string array_ranges(std::span<const std::uint64_t> numbers) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        if (i > 0) text += ",";
        text += fmt::format("{}", numbers[i]);
        if (last > i) text += fmt::format("-{}", numbers[last]);
        i = last + 1;
    }
    return text;
}

std::string SlurmSweep::job_script() const {
    return fmt::format(
        "{}{} --workers 1 --shard \"$SLURM_ARRAY_TASK_ID\" --chunk {} --except {} --store {}\n",
        head(*this), sweep_command(*this), chunk, shell_word(store),
        shard_word(*this, "SLURM_ARRAY_TASK_ID"));
}

std::string SlurmSweep::merge_script() const {
    return fmt::format(
        "{}shards=()\nfor chunk in {}; do shards+=({}); done\n"
        "{} --store {} --merge \"${{shards[@]}}\"\n",
        head(*this), fmt::join(chunks, " "), shard_word(*this, "chunk"), sweep_command(*this),
        shell_word(store));
}

std::vector<std::string> SlurmSweep::submit_job() const {
    std::string array = "--array=" + array_ranges(chunks);
    if (workers > 0) array += fmt::format("%{}", workers);
    return sbatch_words(*this, {array, "--output=" + log_pattern(folder()) + "/logs/%a.log"},
                        job_file());
}

std::vector<std::string> SlurmSweep::submit_merge(const std::string& job) const {
    return sbatch_words(
        *this,
        {"--dependency=afterany:" + job, "--output=" + log_pattern(folder()) + "/logs/merge.log"},
        merge_file());
}

}  // namespace rovernet
