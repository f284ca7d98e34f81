// SPDX-License-Identifier: MIT
#include "models/propagation/rays.hpp"

#include "models/propagation/friis.hpp"
#include "models/propagation/ray_tracer.hpp"
#include "sim/complex_math.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

constexpr std::size_t few_receivers = 8;
constexpr double faintest_path = 30;   // [dB] below the strongest
constexpr double deepest_null = 1e-4;  // of the sum of powers

/// Largest loss of a link relative to free space [dB].
constexpr double most_lost = 200;

/// Upper bound on the gain of all paths together relative to the straight path in free space [dB].
double most_gain(const Rays& model) {
    if (model.order == 0 && model.diffraction == RayDiffraction::none) return 0;
    const double paths = 10 * math::log10(model.max_paths);
    if (model.sum == RaySum::coherent) return 2 * paths;
    return paths + (model.diffraction == RayDiffraction::utd ? 10 * math::log10(2) : 0);
}

/// Sums the paths of one link after the other.
class Summing {
  public:
    Summing(const Rays& model, const RayLimit& limit)
        : model_(model), limit_(limit), wavelength_(speed_of_light / limit.frequency.value) {}

    /// @param losses  [dB] of the paths, at least one
    double operator()(const RayPaths& paths, std::span<const double> losses) {
        choose(losses);
        const double best = *std::min_element(losses.begin(), losses.end());
        double power = 0, power_of_field = 0;
        math::Complex field = 0;
        for (const std::size_t i : chosen_) {
            const double share = math::exp10((best - losses[i]) / 10);
            if (has_phase(paths, paths.paths[i])) {
                power_of_field += share;
                field += std::sqrt(share) * phase_of(paths, paths.paths[i]);
            } else {
                power += share;
            }
        }
        power += std::clamp(std::norm(field), deepest_null * power_of_field,
                            model_.sum == RaySum::coherent ? std::norm(field) + power_of_field
                                                           : 2 * power_of_field);
        return std::max(0.0, best - 10 * math::log10(power));
    }

  private:
    /// Whether the path is added with its phase.
    bool has_phase(const RayPaths& paths, const RayPath& path) const {
        if (model_.sum == RaySum::coherent) return true;
        if (model_.diffraction != RayDiffraction::utd) return false;
        // Distant edges interfere within half a metre, which a mean does not show.
        int around = 0;
        for (const RayEdge& edge : paths.edges(path)) {
            // An edge with a field that is not in the shadow is beside the path.
            if (edge.field && !edge.shadowed) continue;
            if (++around > 1 || edge.detour >= near_edge * wavelength_) return false;
        }
        const auto hits = paths.hits(path);
        return std::none_of(hits.begin(), hits.end(),
                            [](const RayHit& hit) { return hit.kind == RayHit::Kind::reflection; });
    }

    /// Phase of a path, as a complex number of magnitude 1.
    math::Complex phase_of(const RayPaths& paths, const RayPath& path) const {
        const double waves = path.length / wavelength_;
        math::Complex phase = math::phasor(-2 * std::numbers::pi * (waves - std::floor(waves)));
        const auto turn = [&](math::Complex field) {
            const double size = std::sqrt(std::norm(field));
            if (size > 0) phase *= field / size;
        };
        for (const RayHit& hit : paths.hits(path)) turn(limit_.materials.factor(hit).field);
        for (const RayEdge& edge : paths.edges(path))
            turn(limit_.materials.around(edge, limit_.diffraction, limit_.coherent).field);
        return phase;
    }

    /// Selects the strongest paths, and keeps their order.
    void choose(std::span<const double> losses) {
        chosen_.resize(losses.size());
        std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
        const auto most = static_cast<std::size_t>(model_.max_paths);
        if (chosen_.size() <= most) return;
        std::stable_sort(chosen_.begin(), chosen_.end(),
                         [&](std::size_t i, std::size_t k) { return losses[i] < losses[k]; });
        chosen_.resize(most);
        std::sort(chosen_.begin(), chosen_.end());
    }

    const Rays& model_;
    const RayLimit& limit_;
    double wavelength_;
    std::vector<std::size_t> chosen_;
};

}  // namespace

void Rays::check_scene(const Scene& scene) const {
    if (scene.storeys().size() == 1) return;
    throw std::invalid_argument(
        fmt::format("rays: found a scene of {} storeys, but paths are traced within one storey "
                    "only; expected a scene with one map, or another model, such as multi_wall",
                    scene.storeys().size()));
}

Meters Rays::reach(Db loss, Hertz f) const { return Friis{}.reach(loss + Db{most_gain(*this)}, f); }

void Rays::loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
    const Hertz f = links.frequency;
    const double wavelength = speed_of_light / f.value, gain = most_gain(*this);
    const RayMaterials materials(links.scene->materials(), f, wall, wall_loss, reflection_loss);
    const RayLimit limit{materials, f, faintest_path, diffraction, sum == RaySum::coherent};
    Summing sum_of(*this, limit);
    std::optional<RayTracer> tracer;  // nothing is traced for receivers that are too far
    RayPaths paths;
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        out_db[i] = std::max(0.0, free_space_db(links.distance(i), f) - gain);
        if (out_db[i] > cutoff.value) continue;
        if (!tracer)
            tracer.emplace(*links.scene, links.from, order, wavelength,
                           diffraction != RayDiffraction::none,
                           order > 1 && out_db.size() <= few_receivers);
        tracer->trace(links.to[i], &limit, paths);
        const double lost = free_space_db(links.distance(i), f) + most_lost;
        out_db[i] = std::min(sum_of(paths, tracer->losses()), std::max(0.0, lost));
    }
}

Rays::Paths Rays::paths(const LinkBatch& link) const {
    const RayMaterials materials(link.scene->materials(), link.frequency, wall, wall_loss,
                                 reflection_loss);
    const RayLimit limit{materials, link.frequency, faintest_path, diffraction,
                         sum == RaySum::coherent};
    RayTracer tracer(*link.scene, link.from, order, speed_of_light / link.frequency.value,
                     diffraction != RayDiffraction::none, order > 1);
    RayPaths found;
    tracer.trace(link.to[0], &limit, found);
    std::vector<double> losses(tracer.losses().begin(), tracer.losses().end());
    std::sort(losses.begin(), losses.end());
    const std::size_t added = std::min(losses.size(), static_cast<std::size_t>(max_paths));
    double kept = 0, all = 0;
    for (std::size_t i = 0; i < losses.size(); ++i) {
        all += math::exp10((losses[0] - losses[i]) / 10);
        if (i < added) kept = all;
    }
    return {losses.size(), losses.size() - added, Db{10 * math::log10(all / kept)}};
}

}  // namespace rovernet
