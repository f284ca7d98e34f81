// SPDX-License-Identifier: MIT
#include "models/propagation/multi_wall.hpp"

#include "models/propagation/floors_between.hpp"
#include "models/propagation/friis.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <vector>

namespace rovernet {
namespace {

constexpr Meters thinnest_heavy_wall{0.1};

double at_1_m(const MultiWall& model, Hertz f) { return free_space_db(1, f) + model.excess.value; }

/// Power k^e for a number of floors k > 0.
double power(double k, double e) { return math::exp2(e * math::log2(k)); }

double floors_db(const MultiWall& model, double k) {
    if (k == 0) return 0;
    return model.floor_loss.value * power(k, (k + 2) / (k + 1) - model.floor_saving);
}

/// Loss rate of a material; `usual` for a material without a loss of its own.
WallRate rate_with(const Material& material, Hertz f, Db usual) {
    return material.follows_model() ? WallRate{usual.value, 0} : wall_rate(material, f, 0);
}

/// Loss rates of the scene's materials; `usual` for materials without a loss of their own.
std::vector<WallRate> rates_with(const LinkBatch& links, Db usual) {
    std::vector<WallRate> rates;
    for (const Material& material : links.scene->materials())
        rates.push_back(rate_with(material, links.frequency, usual));
    return rates;
}

}  // namespace

Meters MultiWall::reach(Db loss, Hertz f) const {
    const double more = loss.value - at_1_m(*this, f);
    return {more < 0 ? 0 : math::exp10(more / (10 * exponent))};
}

Db MultiWall::wall_loss(const Wall& wall, const Material& material, Hertz f) const {
    const bool heavy = wall.thickness.value >= thinnest_heavy_wall.value;
    const WallRate rate = rate_with(material, f, heavy ? heavy_wall : light_wall);
    return {rate.per_crossing + rate.per_metre * wall.length};
}

void MultiWall::loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
    const double at_1 = at_1_m(*this, links.frequency);
    const WallRates walls{rates_with(links, light_wall), rates_with(links, heavy_wall),
                          thinnest_heavy_wall};
    const FloorCounter floor_counter(links);
    std::vector<Crossing> scratch;
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const FloorsBetween floors = floor_counter.between(i);
        const double way = at_1 + 10 * exponent * math::log10(std::max(links.distance(i), 1.0)) +
                           (floors_db(*this, floors.of_model) + floors.loss_db);
        out_db[i] = std::max(0.0, way);
        if (way > cutoff.value) continue;
        constexpr double slack = 1e-9;  // [dB] more than rounding takes
        out_db[i] =
            std::max(0.0, way + links.scene->wall_loss(links.from, links.to[i], walls,
                                                       cutoff.value - way + slack, scratch));
    }
}

}  // namespace rovernet
