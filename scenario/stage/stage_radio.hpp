// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"

#include <optional>
#include <string>
#include <vector>

// Radios of Stage worlds. Stage's wifi device of 2007 is a model `wifi` on a robot. Its keys and
// units are converted to keys and units of a scenario file.

namespace rovernet {

/// Radio of a Stage robot: its model `wifi`, converted to tables of a [[robot]]. Only keys that the
/// world gives are set. Each value has its position in the world file.
struct StageRadio {
    /// Keys of the table `radio`: power, sensitivity, frequency, essid, ip, netmask, mac, ...
    Table radio = {};
    /// Keys of the robot's table `propagation`: the model, and parameters of any model.
    Table propagation = {};
    /// Seed of the scenario: value of the key `random_seed` of the world's `wifi`; none: not given.
    std::optional<Value> seed = {};
    /// True if the world's `wifi` names a propagation model; false: the model in the table
    /// [propagation] of the scenario is used.
    bool model_given = false;
    /// Notices for the user about unknown keys of the world's `wifi`, one for each key.
    std::vector<std::string> notices = {};
};

/// Converts the model `wifi` of a Stage robot. Units in the world: power [mW], sensitivity [dBm],
/// frequency [MHz], range in the world's unit of length. Stage's names of propagation models and
/// parameters (left) become names of a scenario file (right):
///
///   friis, ITU indoor, log distance,   friis, itu_indoor, log_distance,
///   raytrace, simple                   raytrace_2007, disc
///   plc, ple                           coefficient, exponent
///   link_success_rate n                success_rate (n + 1) / 101: P(draw from 0 ... 100 <= n)
///
/// @throws InputError for a model that Stage does not know and for values of the wrong kind
StageRadio stage_radio(const WorldEntity& wifi, const WorldUnits& units);

}  // namespace rovernet
