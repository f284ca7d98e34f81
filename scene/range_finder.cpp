// SPDX-License-Identifier: MIT
#include "scene/range_finder.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

/// Distance [m] from `from` along a unit vector to a body; `farthest` if the body is not nearer.
double way_to(const RoundBody& body, Vec3 from, Vec3 along, double farthest) {
    const Vec3 to{body.at.x - from.x, body.at.y - from.y, 0};
    const double radius = body.radius.value;
    const double beyond = dot(to, to) - radius * radius;
    if (beyond <= 0) return 0;
    const double ahead = dot(to, along);
    const double half_chord = ahead * ahead - beyond;  // squared
    if (ahead <= 0 || half_chord < 0) return farthest;
    return std::clamp(ahead - std::sqrt(half_chord), 0.0, farthest);
}

/// Bodies within range.
std::vector<RoundBody> near(Vec3 at, double range, std::span<const RoundBody> bodies) {
    std::vector<RoundBody> found;
    for (const RoundBody& each : bodies) {
        const double reach = range + each.radius.value;
        const double dx = each.at.x - at.x, dy = each.at.y - at.y;
        if (dx * dx + dy * dy < reach * reach) found.push_back(each);
    }
    return found;
}

}  // namespace

Radians RangeFinder::step() const {
    return {beams > 1 ? (to.value - from.value) / (beams - 1) : 0};
}

void RangeFinder::measure(const Scene& scene, Vec3 at, Radians heading,
                          std::span<const RoundBody> bodies, std::span<double> out) const {
    if (out.size() != static_cast<std::size_t>(beams)) {
        throw std::invalid_argument("RangeFinder: the output must have one element for each beam");
    }
    const std::vector<RoundBody> in_reach = near(at, range.value, bodies);
    std::vector<Crossing> walls;
    for (int i = 0; i < beams; ++i) {
        const auto [sin, cos] = math::sincos(heading.value + angle(i).value);
        const Vec3 along{cos, sin, 0};
        scene.crossings(at, at + range.value * along, walls);
        double way = walls.empty() ? range.value : std::max(walls.front().entry, 0.0);
        for (const RoundBody& each : in_reach) way = way_to(each, at, along, way);
        out[static_cast<std::size_t>(i)] = way;
    }
}

}  // namespace rovernet
