// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "sim/random.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rovernet {

/// Propagation model that displaces each antenna by `by` [m] for the whole run. The direction
/// (east, north, west or south) is chosen by the robot's key. Robots' movements do not change.
///
///   Displaced{scenario.propagation.make(), Meters{0.01}}
struct Displaced {
    static constexpr std::string_view name = "displaced";

    Propagation model;
    Meters by{0};

    /// Displacement [m] of the antenna of the robot with the given key.
    Vec3 displacement(std::uint64_t key) const {
        const std::array<Vec3, 4> ways{
            {{by.value, 0}, {0, by.value}, {-by.value, 0}, {0, -by.value}}};
        return ways[mix(key) % ways.size()];
    }

    /// Range [m] of the model, extended by the displacements of both antennas, since displacements
    /// may bring the antennas nearer to each other.
    Meters reach(Db loss, Hertz frequency, Meters highest) const {
        constexpr double slack = 1 + 1e-12;  // larger than rounding errors
        return {(model.reach(loss, frequency, highest).value + 2 * by.value) * slack};
    }
    void check_frequency(Hertz frequency) const { model.check_frequency(frequency); }
    void check_scene(const Scene& scene) const { model.check_scene(scene); }

    /// Writes path losses [dB] between displaced antennas: out_db[i] for receiver i of `links`.
    /// @param links   batch of links, with the keys of sender and receivers
    /// @param out_db  one element for each receiver
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        std::vector<Vec3> to(links.to.begin(), links.to.end());
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] = to[i] + displacement(links.to_keys[i]);
        }
        LinkBatch moved = links;
        moved.from = links.from + displacement(links.from_key);
        moved.to = to;
        model.loss(moved, cutoff, out_db);
    }
};

}  // namespace rovernet
