// SPDX-License-Identifier: MIT
#include "pictures/contour.hpp"

#include "sim/fields.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

constexpr double full_turn = 6.283185307179586;
constexpr double fewest_rays = 720;
constexpr double most_rays = 6000;            // to begin with
constexpr std::size_t most_refined = 40'000;  // rays in all
constexpr double ray_spacing = 4;             // [resolutions] between neighbours
constexpr double jump = 6;                    // [resolutions] between the radii of neighbours
constexpr double bisection = 0.25;            // [resolutions] to which a radius is found
constexpr int most_halvings = 50;

struct Ray {
    double angle = 0;  // [rad]
    Vec3 direction = {};
    double radius = 0;  // [m]
};

Ray ray_at(double angle) {
    const auto [sin, cos] = math::sincos(angle);
    return {.angle = angle, .direction = {cos, sin, 0}, .radius = 0};
}

/// Finds radii, many rays at a time.
class Tracer {
  public:
    Tracer(const Transmitter& transmitter, Dbm level, const ContourOptions& options)
        : transmitter_(transmitter), level_(level), resolution_(options.resolution.value) {
        constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
        const Db budget = received_power(transmitter.radio, transmitter.radio, Db{0}) - level;
        const double reach =
            transmitter.model.reach(budget, transmitter.radio.frequency).value * slack;
        farthest_ = std::min(options.farthest.value, std::max(reach, resolution_));
    }

    double farthest() const { return farthest_; }
    double resolution() const { return resolution_; }

    /// Fills in the radius of each ray; 0 if the level is too low right at the antenna.
    void trace(std::vector<Ray>& rays);

  private:
    /// Whether each ray is still above the level at its distance.
    void look(const std::vector<Ray>& rays, const std::vector<double>& distances);

    const Transmitter& transmitter_;
    Dbm level_;
    double resolution_;
    double farthest_ = 0;
    std::vector<Vec3> places_ = {};
    std::vector<double> levels_ = {};
};

void Tracer::look(const std::vector<Ray>& rays, const std::vector<double>& distances) {
    places_.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        places_.push_back(transmitter_.antenna + distances[i] * rays[i].direction);
    }
    levels_.resize(places_.size());
    received_levels(transmitter_, places_, levels_, level_);
}

void Tracer::trace(std::vector<Ray>& rays) {
    std::vector<double> high(rays.size(), farthest_), middle;
    look(rays, high);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].radius = levels_[i] >= level_.value ? farthest_ : 0;
    }
    double width = farthest_;
    for (int n = 0; n < most_halvings && width > bisection * resolution_; ++n, width /= 2) {
        middle.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) middle[i] = (rays[i].radius + high[i]) / 2;
        look(rays, middle);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            (levels_[i] >= level_.value ? rays[i].radius : high[i]) = middle[i];
        }
    }
}

/// Rays between neighbours whose radii jump while they are farther apart than the resolution.
std::vector<Ray> rays_at_jumps(const std::vector<Ray>& rays, double resolution) {
    std::vector<Ray> more;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool last = i + 1 == rays.size();
        const Ray& a = rays[i];
        const Ray& b = rays[last ? 0 : i + 1];
        const double step = b.angle + (last ? full_turn : 0) - a.angle;
        if (std::abs(a.radius - b.radius) <= jump * resolution) continue;
        if (step * std::max(a.radius, b.radius) <= resolution) continue;
        more.push_back(ray_at(a.angle + step / 2));
    }
    return more;
}

void refine(Tracer& tracer, std::vector<Ray>& rays) {
    while (rays.size() < most_refined) {
        std::vector<Ray> more = rays_at_jumps(rays, tracer.resolution());
        if (more.empty()) return;
        if (rays.size() + more.size() > most_refined) return;
        tracer.trace(more);
        std::vector<Ray> all(rays.size() + more.size());
        std::merge(rays.begin(), rays.end(), more.begin(), more.end(), all.begin(),
                   [](const Ray& a, const Ray& b) { return a.angle < b.angle; });
        rays = std::move(all);
    }
}

}  // namespace

std::vector<Vec3> contour(const Transmitter& transmitter, Dbm level,
                          const ContourOptions& options) {
    for (const Meters option : {options.farthest, options.resolution}) {
        if (!positive.contains(option.value)) {
            throw_out_of_range("contour", "farthest and resolution", positive.text, option.value);
        }
    }
    Tracer tracer(transmitter, level, options);
    const double spacing = ray_spacing * tracer.resolution();
    const auto count = static_cast<std::size_t>(
        std::clamp(std::ceil(full_turn * tracer.farthest() / spacing), fewest_rays, most_rays));
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        rays.push_back(ray_at(full_turn * static_cast<double>(i) / static_cast<double>(count)));
    }
    tracer.trace(rays);
    refine(tracer, rays);

    std::vector<Vec3> polygon;
    bool any_inside = false;
    for (const Ray& ray : rays) {
        polygon.push_back(transmitter.antenna + ray.radius * ray.direction);
        any_inside = any_inside || ray.radius > 0;
    }
    if (!any_inside) polygon.clear();
    return polygon;
}

}  // namespace rovernet
