// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/deliveries.hpp"
#include "sim/fate.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_diff.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Delivery in only one of two runs.
struct ChangedDelivery {
    Delivery delivery;
    bool is_gained = false;  ///< true: in only the second run; false: in only the first
    Time time;               ///< time of the delivery, in the run that has it
    /// Fate at the robot of the last frame with this message, in the run without the delivery;
    /// none: no frame with this message was in reach of the robot.
    std::optional<Fate> other = {};
};

/// Comparison of two runs of the same robots.
struct RunComparison {
    /// Number of deliveries in only the second (gained), only the first (lost), and in both runs.
    std::uint64_t gained = 0, lost = 0, same = 0;
    /// Deliveries in only one run, in order of time; if there are more than
    /// ComparisonChoice::most_changes, those of the messages sent first.
    std::vector<ChangedDelivery> changes;
    /// First record in which the runs differ, as `rovernet trace diff` prints it. If
    /// one run is a replay without records of motion, these records are not compared: the robots
    /// move as recorded, but an interrupted leg is shorter in the replay.
    TraceDifference first;
};

/// Recorded trace of a run.
struct NamedTrace {
    std::string path;
    std::string name;  ///< name of the run in error messages
};

/// Options of compare_runs().
struct ComparisonChoice {
    std::size_t most_changes = 100'000;
    bool is_replay = false;  ///< true: the second run is a replay of the first, RecordedDay::record
};

/// Compares two recorded runs: deliveries as `rovernet replay --with` counts them, and records.
/// @throws InputError if a file is no recorded trace, or if the robots of the runs have different
///         names
RunComparison compare_runs(const NamedTrace& a, const NamedTrace& b,
                           const ComparisonChoice& choice = {});

}  // namespace rovernet
