// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Change of a link during a run, with the positions of both robots at that time.
struct LinkHistoryRow {
    Time time;
    std::string from;     ///< robot that is heard
    std::string to;       ///< robot that hears
    bool is_up;           ///< whether the link came up; otherwise it went down
    Vec3 from_at, to_at;  ///< positions of both robots [m]
};

/// Runs the scenario and calls visit() for every change of a link, in the order of time.
/// @param robot  robot that hears: links to other robots are left out; none: all links
/// @throws std::invalid_argument for an unknown robot
void for_each_link_change(const Scenario& scenario, const std::optional<std::string>& robot,
                          const std::function<void(const LinkHistoryRow&)>& visit,
                          const TellTime& tell = {});

/// Header line of the CSV output, for the lines of link_history_csv().
/// @param places  whether the lines have the positions of both robots
std::string link_history_csv_head(bool places);
/// Change of a link as a CSV line.
std::string link_history_csv(const LinkHistoryRow& row, bool places);
/// Change of a link as a document; its keys are the columns of the CSV output.
Table link_history_document(const LinkHistoryRow& row, bool places);

}  // namespace rovernet
