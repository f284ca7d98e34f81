// SPDX-License-Identifier: MIT
#include "models/log_distance.hpp"

#include "models/friis.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"

#include <algorithm>

namespace rovernet {
namespace {

/// The link's shadowing in units of sigma, in [-cut, cut].
double shadow(const LinkBatch& links, std::size_t i) {
    const auto [low, high] = std::minmax(links.from_key, links.to_keys[i]);
    const double x = normal({.seed = links.seed,
                             .replication = links.replication,
                             .purpose = Purpose::link_shadowing,
                             .a = low,
                             .b = high});
    return std::clamp(x, -LogDistance::cut_sigmas, LogDistance::cut_sigmas);
}

}  // namespace

Meters LogDistance::reach(Db loss, Hertz f) const {
    const double d0 = reference_distance.value;
    const double more = loss.value + cut_sigmas * sigma.value - free_space_db(d0, f);
    return {more < 0 ? 0 : d0 * math::exp10(more / (10 * exponent))};
}

void LogDistance::loss(const LinkBatch& links, Db /*give_up*/, std::span<double> out_db) const {
    const double d0 = reference_distance.value;
    const double L0 = free_space_db(d0, links.frequency);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double median =
            L0 + 10 * exponent * math::log10(std::max(links.distance(i) / d0, 1.0));
        const double X = sigma.value > 0 ? sigma.value * shadow(links, i) : 0;
        out_db[i] = std::max(0.0, median + X);
    }
}

}  // namespace rovernet
