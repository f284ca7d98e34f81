// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <numbers>

// Propagation in free space: the path loss without obstacles and reflections.

namespace rovernet {

/// Free-space loss [dB] between isotropic antennas at distance d [m] > 0 and frequency f [Hz]:
///
///   20 log10(4 pi d f / c)
///
/// The loss is negative below d = c / (4 pi f), where the formula is not valid. Other propagation
/// models use free_space_db() for their loss at a reference distance.
///
/// Source: H. T. Friis, A note on a simple transmission formula, Proc. IRE 34(5), 1946.
inline double free_space_db(double d, Hertz f) {
    return 20 * math::log10(4 * std::numbers::pi / speed_of_light * d * f.value);
}

/// Free space (Friis):  L(d) = max(0, 20 log10(4 pi d f / c)), and 0 dB at d = 0.
///
/// Valid in the far field, d > max(lambda, 2 D^2 / lambda) with the antenna diameter D, without
/// objects between or near the antennas. Ground, walls and all obstacles are neglected. Friis is
/// the default propagation model. At 2450 MHz `rovernet loss friis` prints
///
///   1 m   40.23 dB
///   10 m  60.23 dB
///
/// Source: H. T. Friis, A note on a simple transmission formula, Proc. IRE 34(5), 1946.
struct Friis {
    static constexpr std::string_view name = "friis";

    static constexpr auto fields() { return describe(); }

    LossShape shape() const { return LossShape::by_distance; }

    /// Distance [m] at which the loss is `loss`: c / (4 pi f) 10^(loss / 20).
    Meters reach(Db loss, Hertz f) const {
        return {speed_of_light / (4 * std::numbers::pi * f.value) * math::exp10(loss.value / 20)};
    }

    /// Fills out_db[i] with the loss [dB] to receiver i.
    void loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
        for (std::size_t i = 0; i < out_db.size(); ++i) {
            out_db[i] = std::max(0.0, free_space_db(links.distance(i), links.frequency));
        }
    }
};

}  // namespace rovernet
