// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/value.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// The wifi of a Stage robot as tables of a [[robot]]: only what the world gives, each value with
/// its place.
struct StageRadio {
    Table radio = {};        ///< power, sensitivity, frequency, essid, ip, netmask, mac, ...
    Table propagation = {};  ///< model and its parameters, those of other models too
    std::optional<Value> seed = {};         ///< random_seed
    bool model_given = false;               ///< else that of [propagation] rules
    std::vector<std::string> notices = {};  ///< keys that a wifi does not have, one each
};

/// @throws InputError for a model that Stage does not know and for values of the wrong kind
StageRadio stage_radio(const WorldEntity& wifi, const WorldUnits& units);

}  // namespace rovernet
