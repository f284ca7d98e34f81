// SPDX-License-Identifier: MIT
#include "models/propagation/ray_materials.hpp"

#include "models/propagation/edges/diffraction.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rovernet {
namespace {
constexpr double db_per_neper = 8.685889638065037;

/// Loss of a power ratio [dB], finite.
double decibels(double power) {
    constexpr double least = 1e-300;
    return -10 * math::log10(std::max(power, least));
}
}  // namespace

double RayFactor::loss() const { return db_per_neper * decay + decibels(std::norm(field)); }

RayMaterials::RayMaterials(const std::vector<Material>& materials, Hertz frequency,
                           ItuMaterial wall, std::optional<Db> wall_loss, Db reflection_loss)
    : wavelength_(speed_of_light / frequency.value),
      mirror_(-math::exp10(-reflection_loss.value / 20)) {
    for (const Material& m : materials) {
        Entry entry{std::nullopt, std::nullopt, std::numeric_limits<double>::infinity(), {}, 0, 0};
        entry.least.fill(reflection_loss.value);
        if (m.follows_model() && wall_loss) {
            entry.per_crossing = wall_loss->value;
        } else if (m.follows_model()) {
            entry.slab = Slab(wall, frequency);
            entry.thickest = thickest_default_wall.value;
        } else if (m.slab) {
            entry.slab = Slab(*m.slab, frequency);
            entry.thickness = m.thickness.value;
        } else {
            const WallRate rate = wall_rate(m, frequency, 0);
            entry.per_crossing = rate.per_crossing;
            entry.per_metre = rate.per_metre;
        }
        for (std::size_t i = 0; entry.slab && i < entry.least.size(); ++i) {
            const double cosine = std::max(static_cast<double>(i) / 64, grazing);
            entry.least[i] = -10 * math::log10(entry.slab->most_reflected(cosine));
        }
        entries_.push_back(entry);
    }
}

RayFactor RayMaterials::factor(const RayHit& hit) const {
    return hit.kind == RayHit::Kind::reflection
               ? reflected(hit.material, hit.thickness, hit.cosine)
               : crossed(hit.material, hit.thickness, hit.cosine, hit.length);
}

HitLosses RayMaterials::losses_at_slab(std::size_t material, double thickness,
                                       double cosine) const {
    const Entry& entry = entries_[material];
    const SlabPowers powers = entry.slab->powers(entry.slab_thickness(thickness), cosine);
    return {decibels(powers.transmitted) + db_per_neper * powers.decay, decibels(powers.reflected)};
}

double RayMaterials::least_reflection_loss(std::size_t material, double cosine) const {
    return entries_[material].least[static_cast<std::size_t>(64 * cosine)];
}

/// Field behind the wall at an edge, relative to the field without it [-].
math::Complex RayMaterials::through(const RayEdge& edge) const {
    const double cosine = std::clamp(edge.cosine, grazing, 1.0);
    const RayFactor wall = crossed(edge.material, edge.thickness, cosine, edge.thickness / cosine);
    return math::exp(math::Complex{-wall.decay, 0}) * wall.field;
}

RayFactor RayMaterials::around(const RayEdge& edge, RayDiffraction by, bool mirrors) const {
    const math::Complex T = through(edge);
    const auto at_most_1 = [](math::Complex field) {
        return RayFactor{field / std::max(1.0, std::sqrt(std::norm(field))), 0};
    };
    const double kept_out = std::sqrt(std::max(0.0, 1 - std::norm(T)));
    if (edge.field && edge.shadowed) return at_most_1(kept_out * *edge.field);
    if (edge.field) {
        // Phase of the field, with the power that passes through the wall or around it.
        const double past = std::max(std::norm(*edge.field), 1e-300);
        const double through_wall = std::norm(T);
        return at_most_1(std::sqrt((through_wall + (1 - through_wall) * past) / past) *
                         *edge.field);
    }
    if (by == RayDiffraction::knife_edge) {
        if (edge.pair) return at_most_1(kept_out * pair_field(*edge.pair, wavelength_));
        const double nu = 2 * std::sqrt(edge.detour / wavelength_);
        const double loss = knife_edge_loss_p526_db(edge.shadowed ? nu : -nu);
        return {kept_out * math::phasor(-std::numbers::pi / 4), loss / db_per_neper};
    }
    if (edge.pair) {
        // Beside the straight path: loss caused by the pair.
        const math::Complex field = pair_field(*edge.pair, wavelength_);
        return at_most_1((1.0 - T) * (edge.shadowed ? field : field - 1.0));
    }
    const WedgePath path{edge.n, {edge.phi_after}, {edge.phi_before}};
    WedgeFaces faces{0, 0, T};
    if (mirrors) {
        const FaceIncidence at = face_incidence(path);
        const auto mirror = [&](Radians incidence) {
            const double c = std::clamp(math::sincos(incidence.value).cos, grazing, 1.0);
            return reflected(edge.material, edge.thickness, c).field;
        };
        faces.face_0 = mirror(at.face_0);
        faces.face_n = mirror(at.face_n);
    }
    constexpr double nearest = 1e-6;  // [m]
    const double before = std::max(edge.before, nearest), after = std::max(edge.after, nearest);
    const double L = before * after / (before + after);
    LitBy lit = lit_by(path);
    lit.direct = !edge.shadowed;
    const math::Complex D =
        wedge_coefficient(path, 2 * std::numbers::pi / wavelength_, {L}, faces, lit);
    // A path around an edge is at most as strong as a free path of the same length.
    return at_most_1(D / std::sqrt(L));
}

double RayMaterials::beside_edge(const RayEdge& edge) const {
    double loss = knife_edge_loss_p526_db(-2 * std::sqrt(edge.detour / wavelength_));
    if (edge.pair) loss = std::max(loss, decibels(std::norm(pair_field(*edge.pair, wavelength_))));
    const double through_wall = std::min(1.0, std::norm(through(edge)));
    return decibels(through_wall + (1 - through_wall) * math::exp10(-loss / 10));
}

RayFactor RayMaterials::reflected(std::size_t material, double thickness, double cosine) const {
    const Entry& entry = entries_[material];
    if (!entry.slab) return {mirror_, 0};
    return {entry.slab->fields(entry.slab_thickness(thickness), cosine).reflected, 0};
}

RayFactor RayMaterials::crossed(std::size_t material, double thickness, double cosine,
                                double length) const {
    const Entry& entry = entries_[material];
    if (!entry.slab) return {1, (entry.per_crossing + entry.per_metre * length) / db_per_neper};
    const SlabFields fields = entry.slab->fields(entry.slab_thickness(thickness), cosine);
    return {fields.transmitted, fields.decay};
}

}  // namespace rovernet
