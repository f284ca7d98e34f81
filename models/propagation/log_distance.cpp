// SPDX-License-Identifier: MIT
#include "models/propagation/log_distance.hpp"

#include "models/propagation/friis.hpp"
#include "models/propagation/shadowed_range.hpp"
#include "sim/math.hpp"

namespace rovernet {

ShadowedLoss LogDistance::shadowed_loss(Hertz f) const {
    return {.at_reference = free_space_db(reference_distance.value, f) + excess.value,
            .per_decade = 10 * exponent,
            .reference_distance = reference_distance.value,
            .sigma = sigma.value};
}

Meters LogDistance::reach(Db loss, Hertz f) const {
    const double d0 = reference_distance.value;
    const double more =
        loss.value + ShadowedLoss::cut_sigmas * sigma.value - (free_space_db(d0, f) + excess.value);
    return {more < 0 ? 0 : d0 * math::exp10(more / (10 * exponent))};
}

void LogDistance::loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
    const ShadowedLoss at = shadowed_loss(links.frequency);
    if (sigma.value == 0) {
        for (std::size_t i = 0; i < out_db.size(); ++i) out_db[i] = at(links.distance(i), 0);
        return;
    }
    const PairDraws draws = shadowing_draws(links.seed, links.replication);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        out_db[i] = at(links.distance(i), draws.normal(links.from_key, links.to_keys[i]));
    }
}

}  // namespace rovernet
