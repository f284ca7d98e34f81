// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/recorded_day.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Row of the table of `rovernet replay`: a recorded run simulated with one set of radio settings.
struct DayRow {
    std::string radio;  ///< name of the radio settings
    PlayedDay day;
    /// Difference of deliveries between the row StoredReplay::first and this row. None for the row
    /// `first` itself and for the row of the recorded run.
    std::optional<DeliveryChange> change;
};

/// Results of `rovernet replay` to store: one row for each set of radio settings.
struct StoredReplay {
    std::string command;              ///< command line of the replay, without --with; for `explain`
    std::string first;                ///< name of the row with which the other rows are compared
    std::vector<std::string> robots;  ///< names of the robots by NodeId
    std::vector<DayRow> rows;
};

/// Writes the rows of a replay into a study's store, which `results` and `plot` can read. Each row
/// becomes a point with the key "radio" and one run. Each run has the usual metrics; rows with a
/// change also have "gained", "lost", "gained.at.ROBOT" and "lost.at.ROBOT" [deliveries]. The store
/// may already have rows of the same command. A stored row with the same name stays unchanged.
/// @throws InputError if the store belongs to a different command or version; RunError if the
///         store cannot be written
void store_replay(const std::string& path, const StoredReplay& replay);

}  // namespace rovernet
