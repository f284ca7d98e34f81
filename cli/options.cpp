// SPDX-License-Identifier: MIT
#include "cli/options.hpp"

namespace rovernet::cli {

void add_study_file(CLI::App& command, FileArguments& a, const char* what) {
    command.add_option("FILE", a.file, what)->required();
    command.add_option("--seed", a.seed, "seed of every random draw");
    command
        .add_option("--set", a.options.set,
                    "key=value over the file's, such as radio.power=\"15 dBm\"")
        ->allow_extra_args(false);
    command
        .add_option("--world-path", a.options.world_path,
                    "folder for the includes and bitmaps of a Stage world")
        ->allow_extra_args(false);
    command
        .add_option("--bitmap", a.options.bitmaps,
                    "OLD=NEW: another bitmap for one that a Stage world names")
        ->allow_extra_args(false);
    command.add_flag("--lenient", a.options.lenient,
                     "go on without an include or bitmap that is missing");
}

void add_file(CLI::App& command, FileArguments& a, const char* what) {
    add_study_file(command, a, what);
    command.add_option("--replication", a.replication, "which independent repetition");
}

void add_json(CLI::App& command, bool& json) {
    command.add_flag("--json", json, "print one JSON document");
}

void add_interval(CLI::App& command, std::optional<std::string>& interval) {
    command
        .add_option("--interval", interval,
                    "of means: t or betting (default: betting where a metric has two bounds)")
        ->check(CLI::IsMember({"t", "betting"}));
}

}  // namespace rovernet::cli
