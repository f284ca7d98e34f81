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

// Where robots are, as far as the levels tell that they receive from anchors: what `rovernet
// locate` asks. See Locator.

namespace rovernet {

/// What is asked of levels.
struct LocateQuestion {
    /// Standard deviation of a level's error [dB]; if not given, that of the scenario's shadowing.
    std::optional<Db> sigma = {};
    bool knows_power = true;
    /// Places are looked for on the map; on an open field in the box of the anchors, with this
    /// margin [m] around it.
    Meters margin{0};
};

/// Place found from levels.
struct Fix {
    std::string name;                ///< robot, or place of a file of levels
    std::optional<Time> at = {};     ///< time of the run
    std::size_t anchors = 0;         ///< that were heard
    std::optional<Vec3> truth = {};  ///< where it was [m]
    Vec3 found = {};                 ///< where it most likely was [m]
    /// Bound on the rms error [m] at the true place, or else at the one found; none if the anchors
    /// do not tell the place.
    std::optional<Meters> bound = {};

    /// Horizontal distance [m] of what was found from the truth, if that is known.
    std::optional<double> error() const;
};

/// Fixes, in order of time and then of robot, or as in the file.
struct Located {
    Db sigma{0};  ///< of the bounds
    std::vector<Fix> fixes = {};
    std::size_t too_few = 0;  ///< places that heard fewer than three anchors, and have no fix

    /// Root mean square of the errors [m], and of the bounds of the same fixes: of those that have
    /// both. Nothing if none has.
    struct Errors {
        std::size_t fixes;
        double rms, bound;
    };
    std::optional<Errors> errors() const;
};

/// Fewest anchors of a fix: two leave two places.
inline constexpr std::size_t fewest_anchors = 3;

/// Locates all robots but the anchors, at these times of a scenario's run, by the levels that they
/// receive from anchors: with shadowing, without fading, as `rovernet links` lists them. Whoever
/// locates them knows the scenario's propagation model, but not its shadowing.
/// @param anchors  names of robots
/// @throws InputError for an unknown robot, a directional antenna, no known sigma
Located locate_robots(const Scenario& scenario, const std::vector<std::string>& anchors,
                      const std::vector<Time>& times, const LocateQuestion& question);

/// Locates the receivers of a file of measured levels, see read_levels(): senders are the anchors.
/// Receivers' places are the truth; without them the column `place` tells which levels were
/// measured together.
/// @throws InputError for the file, or no known sigma
Located locate_levels(const std::string& path, const Scenario& scenario,
                      const LocateQuestion& question);

}  // namespace rovernet
