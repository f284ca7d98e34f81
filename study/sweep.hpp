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

/// The runs of a study that one of several machines makes: of all of them in their order, those
/// from number * size on, `size` of them.
struct Shard {
    std::uint64_t number, size;
};

/// Progress of a sweep.
struct SweepProgress {
    std::uint64_t before = 0;    ///< finished by an earlier sweep
    std::uint64_t finished = 0;  ///< now
    std::uint64_t failed = 0;    ///< now
    std::uint64_t left = 0;      ///< runs left as known now: precision may ask for more
};

/// Whether a sweep goes on.
enum class Stop { no, when_idle, at_once };

struct SweepOptions {
    std::size_t workers = 2;  ///< > 0
    WorkerLimits limits = {};
    bool fail_fast = false;  ///< begin nothing new once a run has failed
    std::optional<Shard> shard = {};
    /// Replications of each point, by its number, in place of [study] replications and precision.
    std::optional<std::vector<std::uint32_t>> replications = {};
    std::set<std::string> elsewhere = {};  ///< ids of runs that another store has: not made here
    /// Asked all the time.
    std::function<Stop()> stop = [] { return Stop::no; };
    /// Told after every run, and at least every 0.2 s.
    std::function<void(const SweepProgress&)> progress = [](const SweepProgress&) {};
};

/// A point that is not as precise as its study asks, after max_replications.
struct ImprecisePoint {
    std::uint32_t point = 0;
    std::size_t values = 0;            ///< replications in which the metric has a value
    std::optional<double> half_width;  ///< half-width reached; nothing where there is no interval
};

struct SweepResult {
    SweepProgress progress;
    bool stopped = false;              ///< true: it ended before everything was done
    std::optional<StoredRun> failure;  ///< the first
    std::vector<ImprecisePoint>
        imprecise;  ///< points without the precision, of a sweep that was not stopped
};

/// Opens the store of a study, or makes it. @throws InputError if it has runs of another version or
/// of points that the study does not have; RunError if it cannot be written
Store open_store(const std::string& path, Study& study);

/// The ids of a store's finished runs.
std::set<std::string> finished_runs(const Store& store);

/// Runs of a study and what a store has of each, in the order that shards divide. Of a study with a
/// precision, only of the runs that every point is asked for.
std::vector<RunState> run_states(const Study& study, const Store& store);

/// Runs what the store does not have yet, and what failed, in worker processes; each run is in the
/// store as soon as it is over. A run whose process dies is tried once more. In all, each point is
/// repeated [study] replications times; with `precision` until the interval of the first metric is
/// that narrow, see reached_precision(), up to max_replications. What is run depends on results
/// alone, never on which run ended first.
/// @throws RunError if the store cannot be written any more
SweepResult sweep(Study& study, Store& store, const SweepOptions& options);

}  // namespace rovernet
