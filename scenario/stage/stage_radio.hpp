// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"

#include <optional>
#include <string>
#include <vector>

// Radios of Stage worlds. The radio of the 2007 device was a sensor of its robot, `wifi`, with keys
// and units of its own; here they become those of a scenario file.

namespace rovernet {

/// Radio of a Stage robot: its wifi as tables of a [[robot]], only what the world gives, each value
/// with its place.
struct StageRadio {
    /// Keys of `radio`: power, sensitivity, frequency, essid, ip, netmask, mac, ...
    Table radio = {};
    /// Keys of `propagation`: the model and its parameters, those of other models too.
    Table propagation = {};
    /// Seed of all draws of the 2007 device: random_seed.
    std::optional<Value> seed = {};
    /// The wifi names a model; otherwise that of [propagation] rules.
    bool model_given = false;
    /// Notices of keys that a wifi does not have, one each.
    std::vector<std::string> notices = {};
};

/// Reads the wifi of a robot. Units are those of the world: power [mW], sensitivity [dBm],
/// frequency [MHz], range in the world's unit of length. Models and parameters have other names
/// there:
///
///   friis, ITU indoor, log distance,   friis, itu_indoor, log_distance,
///   raytrace, simple                   raytrace_2007, disc
///   plc, ple                           coefficient, exponent
///   link_success_rate n                success_rate (n + 1) / 101: a draw from 0 to 100 is <= n
///
/// @throws InputError for a model that Stage does not know and for values of the wrong kind
StageRadio stage_radio(const WorldEntity& wifi, const WorldUnits& units);

}  // namespace rovernet
