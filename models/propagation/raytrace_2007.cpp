// SPDX-License-Identifier: MIT
#include "models/propagation/raytrace_2007.hpp"

#include "models/propagation/floors_between.hpp"
#include "models/propagation/itu_indoor.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <vector>

namespace rovernet {
namespace {

/// Loss without walls [dB], exactly that of itu_indoor_db; the frequency term is computed once.
class FreeLoss {
  public:
    FreeLoss(Hertz f, double N) : of_frequency_(20 * math::log10(f.value / 1e6)), N_(N) {}
    double operator()(double d) const {
        return std::max(0.0, of_frequency_ + N_ * math::log10(std::max(d, 1.0)) - 28);
    }

  private:
    double of_frequency_;
    double N_;
};

}  // namespace

Meters Raytrace2007::reach(Db loss, Hertz f) const {
    return itu_indoor_reach(loss, f, coefficient);
}

void Raytrace2007::loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
    if (!links.scene->plain_walls()) return loss_by_materials(links, cutoff, out_db);
    const double db_per_metre = 100 * wall_factor;
    // The limit is slightly above the budget, so that rounding never breaks a link that is just up.
    constexpr double slack = 1 + 1e-12;
    const FreeLoss free_loss(links.frequency, coefficient);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double free = free_loss(links.distance(i));
        out_db[i] = free;
        if (db_per_metre == 0 || free > cutoff.value) continue;
        const double enough = (cutoff.value - free) / db_per_metre * slack;
        out_db[i] += db_per_metre * links.scene->wall_length(links.from, links.to[i], enough);
    }
}

void Raytrace2007::loss_by_materials(const LinkBatch& links, Db cutoff,
                                     std::span<double> out_db) const {
    std::vector<WallRate> rates;
    for (const Material& material : links.scene->materials()) {
        rates.push_back(wall_rate(material, links.frequency, 100 * wall_factor));
    }
    std::vector<Crossing> scratch;
    const FreeLoss free_loss(links.frequency, coefficient);
    const FloorCounter floor_counter(links);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double free = free_loss(links.distance(i)) + floor_counter.between(i).loss_db;
        out_db[i] = free;
        if (free > cutoff.value) continue;
        out_db[i] += links.scene->wall_loss(links.from, links.to[i], rates,
                                            cutoff.value - free + 1e-9, scratch);
    }
}

}  // namespace rovernet
