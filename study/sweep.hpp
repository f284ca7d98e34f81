// SPDX-License-Identifier: MIT
#pragma once

#include "study/inventory.hpp"
#include "study/store.hpp"
#include "study/study.hpp"
#include "study/workers.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rovernet {

/// Part of a study's runs, for one of several machines. It contains the runs with indices `number *
/// size` to `(number + 1) * size - 1`, in the order of run_states().
struct Shard {
    std::uint64_t number, size;
};

/// Progress of a sweep (execution of all missing runs of a study).
struct SweepProgress {
    std::uint64_t before = 0;    ///< number of runs that earlier sweeps finished
    std::uint64_t finished = 0;  ///< number of runs finished in this sweep
    std::uint64_t failed = 0;    ///< number of runs failed in this sweep
    std::uint64_t left = 0;      ///< number of planned runs that remain; `precision` may add more
    std::uint64_t searches = 0;  ///< number of path searches made by the worker processes
};

/// Request to stop a sweep. no: do not stop. when_idle: stop after the running tasks have ended.
/// at_once: kill the running tasks and stop immediately.
enum class Stop { no, when_idle, at_once };

struct SweepOptions {
    std::size_t workers = 2;  ///< number of worker processes, > 0
    WorkerLimits limits = {};
    bool fail_fast = false;  ///< true: no new run is started after a run has failed
    /// True: in a scene with walls, one worker makes all runs of a replication, so that paths are
    /// searched only once for points with the same robots and positions. False: any worker makes
    /// any run.
    bool replication_on_one_worker = false;
    std::optional<Shard> shard = {};
    /// Number of replications of each point, by point number, in place of [study] replications and
    /// precision. None: as in [study].
    std::optional<std::vector<std::uint32_t>> replications = {};
    std::set<std::string> elsewhere = {};  ///< ids of runs to skip: runs that other stores have
    /// Function that returns whether to stop the sweep; called at least every 0.2 s.
    std::function<Stop()> stop = [] { return Stop::no; };
    /// Function that receives the progress; called after every run, and at least every 0.2 s.
    std::function<void(const SweepProgress&)> progress = [](const SweepProgress&) {};
};

/// Point of a study that did not reach the required `precision` within max_replications.
struct ImprecisePoint {
    std::uint32_t point = 0;
    std::size_t values = 0;            ///< number of replications in which the metric has a value
    std::optional<double> half_width;  ///< half-width of the confidence interval, if it exists
};

struct SweepResult {
    SweepProgress progress;
    bool stopped = false;                   ///< true: the sweep was stopped early
    std::optional<StoredRun> failure;       ///< first run that failed; none: no run failed
    std::vector<ImprecisePoint> imprecise;  ///< points that did not reach the precision; empty if
                                            ///< stopped
};

/// Opens or creates the store of a study. @throws InputError if the store has runs of a different
/// version, or points that the study does not have; RunError if the store cannot be written
Store open_store(const std::string& path, Study& study);

/// Ids of the finished runs in a store.
std::set<std::string> finished_runs(const Store& store);

/// State of each run of a study in a store, in the order of the runs: replication 0 of every point,
/// then replication 1, and so on to [study] replications, also if `precision` is given.
std::vector<RunState> run_states(const Study& study, const Store& store);

/// Makes the missing and failed runs of a study in worker processes, and stores each run as soon as
/// the run ends. A run whose process dies is tried once more. Each point gets [study] replications.
/// With `precision`, further replications follow until the interval of the first metric is narrow
/// enough, see reached_precision(), up to max_replications. The set of runs depends on results
/// only, never on the order in which runs end.
/// @throws RunError if the store cannot be written
SweepResult sweep(Study& study, Store& store, const SweepOptions& options);

}  // namespace rovernet
