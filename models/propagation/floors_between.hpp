// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "scene/material.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet {

/// Floors between the antennas of a link. A floor costs either what its ceiling is made of, or what
/// the model says, never both.
struct FloorsBetween {
    /// Floors that cost what the model says [-], a whole number.
    double of_model = 0;
    /// Loss of the others [dB].
    double loss_db = 0;
};

/// Counts the ceilings of a scene of several storeys; in another scene all floors are the model's,
/// one every `floor_height`, and a thousand at most.
inline FloorsBetween floors_between(const LinkBatch& links, std::size_t i) {
    FloorsBetween floors;
    if (!links.scene || links.scene->storeys().size() == 1) {
        const auto storey = [&](Vec3 p) { return std::floor(p.z / links.floor_height.value); };
        constexpr double most = 1000;
        floors.of_model = std::min(std::abs(storey(links.to[i]) - storey(links.from)), most);
        return floors;
    }
    for (const Material& ceiling :
         links.scene->storeys().ceilings_between(links.from.z, links.to[i].z)) {
        if (ceiling.follows_model()) {
            ++floors.of_model;
        } else {
            floors.loss_db += wall_rate(ceiling, links.frequency, 0).per_crossing;
        }
    }
    return floors;
}

}  // namespace rovernet
