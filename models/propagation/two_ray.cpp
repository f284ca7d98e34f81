// SPDX-License-Identifier: MIT
#include "models/propagation/two_ray.hpp"

#include "models/propagation/friis.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <numbers>

namespace rovernet {

Meters TwoRay::reach(Db loss, Hertz f, Meters highest) const {
    const double height = std::max(highest.value, lowest_antenna.value);
    return {std::min(Friis{}.reach(loss, f).value, height * math::exp10(loss.value / 40))};
}

void TwoRay::loss(const LinkBatch& links, Db /*give_up*/, std::span<double> out_db) const {
    const Hertz f = links.frequency;
    const auto height = [&](Vec3 antenna) { return std::max(antenna.z, lowest_antenna.value); };
    const double ht = height(links.from);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double d = links.distance(i);
        const double crossover =
            4 * std::numbers::pi / speed_of_light * f.value * (ht * height(links.to[i]));
        out_db[i] = std::max(0.0, free_space_db(d * std::max(1.0, d / crossover), f));
    }
}

}  // namespace rovernet
