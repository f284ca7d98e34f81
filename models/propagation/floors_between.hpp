// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "scene/materials/material.hpp"
#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rovernet {

/// Floors between the antennas of a link. The loss of a floor is either that of its ceiling's
/// material or that of the propagation model, never both.
struct FloorsBetween {
    /// Number of floors whose loss the propagation model determines [-], a whole number.
    double of_model = 0;
    /// Loss [dB] of the floors whose ceilings have a material with a loss.
    double loss_db = 0;
};

/// Counter of the floors crossed by a batch's links. In a scene of several storeys the floors are
/// its ceilings, whose losses are computed once. In other scenes there is a floor every
/// `floor_height`, if given, with the loss of the propagation model; at most 1000 floors are
/// counted.
class FloorCounter {
  public:
    /// @param links  batch of links; must outlive the FloorCounter
    explicit FloorCounter(const LinkBatch& links) : links_(links) {
        if (!links.scene) return;
        for (const Material& ceiling : links.scene->storeys().ceilings()) {
            ceilings_.push_back(ceiling.follows_model()
                                    ? FloorsBetween{.of_model = 1}
                                    : FloorsBetween{.loss_db = loss_of(ceiling, links)});
        }
    }

    /// Floors between the antennas of link i of the batch.
    FloorsBetween between(std::size_t i) const {
        const double here = links_.from.z, there = links_.to[i].z;
        FloorsBetween floors;
        if (ceilings_.empty()) {
            if (links_.floor_height == no_storeys) return floors;
            const auto storey = [&](double z) { return std::floor(z / links_.floor_height.value); };
            constexpr double most = 1000;
            floors.of_model = std::min(std::abs(storey(there) - storey(here)), most);
            return floors;
        }
        const Storeys& storeys = links_.scene->storeys();
        const auto [low, high] = std::minmax({storeys.number_at(here), storeys.number_at(there)});
        for (std::size_t k = low; k < high; ++k) {
            floors.of_model += ceilings_[k].of_model;
            floors.loss_db += ceilings_[k].loss_db;
        }
        return floors;
    }

  private:
    static double loss_of(const Material& ceiling, const LinkBatch& links) {
        return wall_rate(ceiling, links.frequency, 0).per_crossing;
    }

    const LinkBatch& links_;
    // Contribution of each ceiling to the floors of a link, from the lowest ceiling on; empty if
    // the scene has one storey.
    std::vector<FloorsBetween> ceilings_;
};

}  // namespace rovernet
