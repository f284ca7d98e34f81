// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Localisation of robots by levels received from anchors (transmitters at known positions):
// `rovernet locate`. See Locator.

namespace rovernet {

/// Settings of a localisation by received levels.
struct LocateQuestion {
    /// Standard deviation of the error of a received level [dB]; none: sigma of the scenario's
    /// shadowing.
    std::optional<Db> sigma = {};
    bool knows_power = true;
    /// Margin [m] around the bounding box of the anchors (transmitters of known position). On an
    /// open field, positions are searched in the box extended by the margin. With a map, the whole
    /// map is searched.
    Meters margin{0};
};

/// Position of a robot, estimated from received levels.
struct Fix {
    std::string name;                ///< name of the robot, or place in a file of levels
    std::optional<Time> at = {};     ///< simulated time of the estimate; none: from a file
    std::size_t anchors = 0;         ///< number of anchors (known transmitters) that were received
    std::optional<Vec3> truth = {};  ///< true position [m]; none: unknown
    Vec3 found = {};                 ///< estimated position [m]
    /// Lower bound of the rms position error [m] at the true position, or at the estimate if the
    /// true position is unknown. None if the anchors (known transmitters) do not determine the
    /// position.
    std::optional<Meters> bound = {};

    /// Horizontal distance [m] between estimate and true position; none if the true position is
    /// unknown.
    std::optional<double> error() const;
};

/// Result of a localisation. locate_robots() orders the fixes by time, then by robot.
/// locate_levels() orders them by first occurrence of the place in the file.
struct Located {
    Db sigma{0};  ///< standard deviation of the error of a level [dB], used for Fix::bound
    std::vector<Fix> fixes = {};
    /// Number of positions that were not estimated, since fewer than three anchors (known
    /// transmitters) were received.
    std::size_t too_few = 0;

    /// Root mean squares [m] of position errors and of their lower bounds, over the fixes that have
    /// both error and bound.
    struct Errors {
        std::size_t fixes;
        double rms, bound;
    };
    /// Root mean squares of position errors and their bounds; none if no fix has both values.
    std::optional<Errors> errors() const;
};

/// Least number of anchors (transmitters of known position) for a fix. Two anchors would leave two
/// possible positions.
inline constexpr std::size_t fewest_anchors = 3;

/// Locates all robots except the anchors (transmitters of known position), at given times of a
/// scenario's run, by the levels received from anchors. Levels include shadowing but no fading, as
/// in `rovernet links`. The locator uses the scenario's propagation model, without knowing the
/// shadowing.
/// @param anchors  names of the robots that are anchors
/// @throws InputError for an unknown robot, for an anchor with a directional antenna, or if neither
///         `question` nor the scenario gives the standard deviation of levels
Located locate_robots(const Scenario& scenario, const std::vector<std::string>& anchors,
                      const std::vector<Time>& times, const LocateQuestion& question);

/// Locates the receivers of a file of measured levels, see read_levels(). The senders are the
/// anchors. Receiver positions in the file are the true positions. If the file has no receiver
/// positions, the column `place` groups levels that were measured together.
/// @throws InputError if the file is invalid, or if neither `question` nor the scenario gives the
///         standard deviation of levels
Located locate_levels(const std::string& path, const Scenario& scenario,
                      const LocateQuestion& question);

}  // namespace rovernet
