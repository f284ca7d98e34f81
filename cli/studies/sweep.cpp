// SPDX-License-Identifier: MIT
#include "study/sweep.hpp"

#include "cli/runs/run_commands.hpp"
#include "cli/studies/slurm.hpp"
#include "cli/studies/study_run.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "files/input_file.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "study/inventory.hpp"
#include "study/merge.hpp"
#include "study/write_lock.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <unistd.h>

namespace rovernet::cli {
namespace {

std::string store_path(const SweepArguments& a) {
    if (a.store) return *a.store;
    if (a.file == standard_input) {
        throw std::invalid_argument(
            "sweep -: a scenario from standard input has no file name after which to name the "
            "store; expected --store "
            "FILE");
    }
    return std::filesystem::path(a.file).replace_extension(".db").string();
}

/// Words for what of a store is thrown away: "its 12 runs"; empty if it has none.
std::string runs_in(const std::string& path) {
    if (input_kind(path) == InputKind::nothing) return "";
    const Store store = Store::open(path);  // throws for a file that is something else
    try {
        const std::size_t runs = store.runs().size();
        return runs == 0 ? "" : "its " + runs_text(runs);
    } catch (const InputError&) {
        return "its runs (the store is damaged)";
    }
}

/// Deletes the store and its shards, if the user confirms.
void begin_afresh(const SweepArguments& a, const std::string& path) {
    const std::string shards = path + ".slurm/shards";
    const bool has_shards =
        input_kind(shards) == InputKind::folder && !std::filesystem::is_empty(shards);
    const std::string runs = runs_in(path);
    if ((!runs.empty() || has_shards) && !a.yes) {
        const std::string question =
            fmt::format("{}: delete {}{}?", path, runs.empty() ? "its 0 runs" : runs,
                        has_shards ? " and its shards on Slurm" : "");
        if (isatty(STDIN_FILENO) == 0) {
            throw std::invalid_argument("--fresh: " + question + " Confirm this with --yes");
        }
        to_terminal(question + " [y/N] ");
        std::string answer;
        std::getline(std::cin, answer);
        if (answer != "y" && answer != "yes")
            throw std::invalid_argument("the deletion was not confirmed, so nothing was changed");
    }
    std::optional<WriteLock> nobody_else_writes;  // or what they write is lost with its file
    if (input_kind(path) == InputKind::file) nobody_else_writes.emplace(path);
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path + ending);
    std::filesystem::remove_all(shards);
}

void print_plan(const SweepArguments& a, const Study& study) {
    const auto& points = study.points();
    const std::uint64_t runs =
        points.size() * static_cast<std::uint64_t>(study.table().replications);
    if (!a.json) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            fmt::print("{:>6}  {}\n", i, settings_text(points[i].settings));
        }
        fmt::print("{} points x {} replications = {} runs{}\n", points.size(),
                   study.table().replications, runs,
                   study.table().precision ? " at least; more, if the precision needs them" : "");
        return;
    }
    Array list;
    for (const StudyPoint& point : points) {
        Table row;
        row.set("id", point.id);
        row.set("settings", point.settings);
        list.emplace_back(std::move(row));
    }
    Table table;
    table.set("points", std::move(list));
    table.set("replications", study.table().replications);
    table.set("runs", runs);
    fmt::print("{}", to_json(table));
}

Array imprecise_points(const Study& study, const SweepResult& result) {
    Array list;
    for (const ImprecisePoint& point : result.imprecise) {
        Table row;
        row.set("point", std::uint64_t{point.point});
        row.set("settings", study.points()[point.point].settings);
        row.set("n", std::uint64_t{point.values});
        row.set("half_width", point.half_width);
        list.emplace_back(std::move(row));
    }
    return list;
}

void print_end(const SweepArguments& a, const Study& study, const Store& store,
               const SweepResult& result) {
    const SweepProgress& p = result.progress;
    if (a.json) {
        Table table;
        table.set("store", store.path());
        table.set("before", p.before);
        table.set("finished", p.finished);
        table.set("failed", p.failed);
        table.set("left", p.left);
        if (study.table().precision) {
            table.set("precision", *study.table().precision);
            table.set("imprecise", imprecise_points(study, result));
        }
        fmt::print("{}", to_json(table));
        return;
    }
    notice(fmt::format("{} finished{}, {} failed, {} left; results in {}", runs_text(p.finished),
                       p.before > 0 ? fmt::format(", {} {} already stored", p.before,
                                                  p.before == 1 ? "was" : "were")
                                    : "",
                       p.failed, p.left, store.path()));
}

}  // namespace

void sweep(const SweepArguments& a) {
    Study study(a.file, study_options(a));
    for (const std::string& text : study.base().notices) notice(text);
    tell_ignored(study, IgnoredBy::file);
    const bool on_slurm = a.executor == "slurm";
    if (a.dry_run && !on_slurm) return print_plan(a, study);
    if ((a.shard || on_slurm || !a.merge.empty()) && study.table().precision) {
        throw std::invalid_argument(
            "--shard, --merge and --executor slurm need a number of runs that is fixed beforehand, "
            "but with [study] precision the sweep determines this number; expected [study] "
            "replications without precision");
    }
    const std::string path = store_path(a);
    if (a.fresh && !a.dry_run) begin_afresh(a, path);
    if (on_slurm) return submit_sweep(a, study, path);
    for (const std::string& shard : a.merge) check_shard(shard);
    Store store = open_store(path, study);
    if (!a.merge.empty()) return merge_shards(a, study, store);
    SweepOptions options;
    if (a.shard) options.shard = Shard{*a.shard, a.chunk};
    if (a.except) options.elsewhere = finished_runs(Store::open(*a.except));
    const SweepResult result = run_study(a, study, store, options);
    print_end(a, study, store, result);
    check_end(a, store, result);
    check_precision(study, result);
}

}  // namespace rovernet::cli
