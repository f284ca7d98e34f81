// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/recorded_day.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A day under one radio: a row of a replay.
struct DayRow {
    std::string radio;  ///< name of the row
    PlayedDay day;
    std::optional<DeliveryChange> change;  ///< to the first row; none: it is that, or the trace's
};

/// A replay whose rows a store keeps.
struct StoredReplay {
    std::string command;              ///< that made them, without --with; for `explain`
    std::string first;                ///< name of the row that others are compared with
    std::vector<std::string> robots;  ///< names by NodeId
    std::vector<DayRow> rows;
};

/// Keeps rows of a replay in a store that `results` and `plot` read: a point for each radio, with
/// the key "radio", and one run of it. Metrics are those of every run, and of a row with a change
/// "gained", "lost", "gained.at.ROBOT" and "lost.at.ROBOT" [deliveries]. Rows of the same command
/// may be there already; one of the same name stays as it is.
/// @throws InputError if the store is of another command or version; RunError if it cannot be
///         written
void store_replay(const std::string& path, const StoredReplay& replay);

}  // namespace rovernet
