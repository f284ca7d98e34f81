// SPDX-License-Identifier: MIT
#include "models/propagation/itu_site_general.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet {
namespace {

struct Row {
    double lowest_ghz, highest_ghz;
    double a, b, g;
    double at_1_m(Hertz f) const { return b + 10 * g * math::log10(f.value / 1e9); }
};

/// ITU-R P.1238-11, table 2: by site, with line of sight and without.
constexpr std::array<std::array<Row, 2>, 3> rows{{
    {{{0.3, 83.5, 1.46, 34.62, 2.03}, {0.3, 82, 2.46, 29.53, 2.38}}},
    {{{0.3, 83.5, 1.63, 28.12, 2.25}, {0.625, 83.5, 2.77, 29.27, 2.48}}},
    {{{0.625, 70.28, 2.31, 24.52, 2.06}, {0.625, 70.28, 3.79, 21.01, 1.34}}},
}};

const Row& row_of(Site site, bool clear) {
    return rows[static_cast<std::size_t>(site)][clear ? 0 : 1];
}

/// Loss of a row as a function of distance [m]; the frequency term is computed once.
class Curve {
  public:
    Curve(const Row& row, Hertz f) : slope_(10 * row.a), at_1_m_(row.at_1_m(f)) {}
    double operator()(double d) const {
        return std::max(0.0, slope_ * math::log10(std::max(d, 1.0)) + at_1_m_);
    }

  private:
    double slope_, at_1_m_;
};

Meters reach_of(const Row& row, Db loss, Hertz f) {
    const double more = loss.value - row.at_1_m(f);
    return {more < 0 ? 0 : math::exp10(more / (10 * row.a))};
}

}  // namespace

void ItuSiteGeneral::check_frequency(Hertz f) const {
    const double ghz = f.value / 1e9;
    for (const bool clear : {true, false}) {
        if (los == (clear ? LineOfSight::no : LineOfSight::yes)) continue;
        const Row& row = row_of(site, clear);
        if (ghz >= row.lowest_ghz && ghz <= row.highest_ghz) continue;
        throw std::invalid_argument(fmt::format(
            "itu_site_general: found {} GHz; for site \"{}\" {} line of sight, the model is valid "
            "from "
            "{} to {} GHz",
            ghz, name_of(site), clear ? "with" : "without", row.lowest_ghz, row.highest_ghz));
    }
}

Meters ItuSiteGeneral::reach(Db loss, Hertz f) const {
    Meters reach{0};
    if (los != LineOfSight::no) reach = std::max(reach, reach_of(row_of(site, true), loss, f));
    if (los != LineOfSight::yes) reach = std::max(reach, reach_of(row_of(site, false), loss, f));
    return reach;
}

void ItuSiteGeneral::loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
    const Curve clear(row_of(site, true), links.frequency);
    const Curve blocked(row_of(site, false), links.frequency);
    const auto is_clear = [&](Vec3 to) {
        if (los != LineOfSight::map) return los == LineOfSight::yes;
        return links.scene->storeys().ceilings_between(links.from.z, to.z).empty() &&
               !links.scene->passes_wall(links.from, to);
    };
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double d = links.distance(i);
        out_db[i] = is_clear(links.to[i]) ? clear(d) : blocked(d);
    }
}

}  // namespace rovernet
