// SPDX-License-Identifier: MIT
#include "models/raytrace_2007.hpp"

#include "models/itu_indoor.hpp"

#include <algorithm>

namespace rovernet {

Meters Raytrace2007::reach(Db loss, Hertz f) const {
    return itu_indoor_reach(loss, f, coefficient);
}

void Raytrace2007::loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const {
    const double db_per_metre = 100 * wall_factor;
    // A hair more than the budget buys, so that rounding never cuts a link that is just up.
    constexpr double slack = 1 + 1e-12;
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double free =
            std::max(0.0, itu_indoor_db(links.distance(i), links.frequency, coefficient, 0));
        out_db[i] = free;
        if (db_per_metre == 0 || free > give_up.value) continue;
        const double enough = (give_up.value - free) / db_per_metre * slack;
        out_db[i] += db_per_metre * links.scene->wall_length(links.from, links.to[i], enough);
    }
}

}  // namespace rovernet
