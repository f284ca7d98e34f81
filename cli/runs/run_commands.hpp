// SPDX-License-Identifier: MIT
#pragma once

#include "cli/run/run.hpp"
#include "cli/runs/view_option.hpp"
#include "cli/terminal/commands.hpp"
#include "study/advise/advise_candidates.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Commands that run a scenario, once or many times: run, sweep, compare, advise, fit, probe.
namespace rovernet::cli {

/// Arguments of the command `run`, which with --view serves a page that shows and paces the run.
struct ViewedRunArguments : RunArguments {
    ViewOption view;
    Reach reach;
};
void run_or_view(const ViewedRunArguments& arguments);

/// Arguments shared by the commands that run a study: sweep, compare, advise.
struct StudyArguments : FileArguments {
    std::optional<std::string> store;
    std::optional<std::uint64_t> replications, max_replications;
    std::optional<double> precision, confidence;
    std::optional<std::string> interval;
    std::uint64_t workers = 0;  ///< number of worker processes; 0: one for each processor
    std::optional<std::string> timeout, memory;
    bool fail_fast = false, json = false;
    std::string command;  ///< command line of the program as the user typed it
};

struct SweepArguments : StudyArguments {
    std::optional<std::uint64_t> shard;
    std::uint64_t chunk = 50;
    std::optional<std::string> except;  ///< path of a store whose finished runs this sweep skips
    std::vector<std::string> merge;     ///< paths of stores to merge into the study's store
    std::string executor = "local", sbatch;
    bool dry_run = false, resume = false, fresh = false, yes = false;
};
void sweep(const SweepArguments& arguments);

struct CompareArguments : StudyArguments {
    std::vector<std::string> models, protocols;
    std::optional<std::string> vary;  ///< values to compare instead of models: KEY=VALUE,VALUE,...
    std::vector<std::string> metrics;
    std::string baseline;
    std::optional<double> margin;
    bool csv = false;
    std::optional<std::string> picture;
};
void compare(const CompareArguments& arguments);

struct AdviseArguments : StudyArguments {
    std::string metric = "delivery_ratio", criterion = "mean";
    std::optional<double> tolerance;
    CandidateQuestion question;
    bool no_cost = false;
    std::string budget = "10 min";
    std::optional<std::string> picture;
};
void advise(const AdviseArguments& arguments);

struct FitArguments : FileArguments {
    std::string to;
    std::optional<std::string> links, check, floor;
    bool gains = false;
    bool json = false;
};
void fit(const FitArguments& arguments);

struct ProbeArguments : FileArguments {
    std::size_t links = 1000, top = 10;
    bool no_messages = false;
    bool json = false;
};
void probe(const ProbeArguments& arguments);

}  // namespace rovernet::cli
