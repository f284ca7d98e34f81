// SPDX-License-Identifier: MIT
#include "models/propagation/ray_edges.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rovernet {
namespace {

using std::numbers::pi;

Vec3 flat(Vec3 p) { return {p.x, p.y, 0}; }
double cross(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }
Vec3 direction(const Face& f) { return {-f.normal.y, f.normal.x, 0}; }

/// Angle from one direction to another [rad], counter-clockwise, -pi to pi.
double turn(Vec3 from, Vec3 to) { return math::atan2(cross(from, to), dot(from, to)); }
/// Turn counter-clockwise, 0 to 2 pi.
double angle(Vec3 from, Vec3 to) {
    const double a = turn(from, to);
    return a < 0 ? a + 2 * pi : a;
}

/// Corners of an edge that the ends of a way around it see: of both, the one nearer to the way.
/// Nothing if an end sees none.
std::optional<std::pair<std::size_t, std::size_t>> corners_seen(const WallEdge& edge,
                                                                const Face& before,
                                                                const Face& behind, Vec3 a,
                                                                Vec3 b) {
    const Vec3 across = edge.corners[1] - edge.corners[0];
    // Past the line through both corners, away from the wall, both can be seen.
    const auto sees_both = [&](Vec3 p) { return cross(across, flat(p) - edge.corners[0]) < 0; };
    const auto corner_of = [&](Vec3 p) -> std::optional<std::size_t> {
        if (before.in_front(p) > 0) return 0;
        if (behind.in_front(p) > 0) return 1;
        return std::nullopt;
    };
    const bool free_a = sees_both(a), free_b = sees_both(b);
    auto at_a = corner_of(a), at_b = corner_of(b);
    if (free_a && free_b) {
        const auto by = [&](Vec3 c) { return distance(flat(a), c) + distance(c, flat(b)); };
        at_a = at_b = by(edge.corners[0]) <= by(edge.corners[1]) ? 0 : 1;
    } else if (free_a) {
        at_a = at_b;
    } else if (free_b) {
        at_b = at_a;
    }
    if (!at_a || !at_b) return std::nullopt;
    return std::pair{*at_a, *at_b};
}

}  // namespace

RayEdges::RayEdges(std::span<const Face> faces, double wavelength) : faces_(faces) {
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i;
        while (end < faces.size() && faces[end].outline == faces[i].outline) ++end;
        add_outline(faces.subspan(i, end - i), i, 5 * wavelength);
        i = end;
    }
}

void RayEdges::add_outline(std::span<const Face> outline, std::size_t first, double shortest) {
    std::vector<std::size_t> sides;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (outline[i].length >= shortest) sides.push_back(i);
    for (std::size_t s = 0; sides.size() >= 2 && s < sides.size(); ++s) {
        const std::size_t i = sides[s], k = sides[(s + 1) % sides.size()];
        const Face &before = outline[i], &behind = outline[k];
        double turned = 0;
        Vec3 heading = direction(before);
        for (std::size_t f = (i + 1) % outline.size();; f = (f + 1) % outline.size()) {
            if (outline[f].length > 0) {
                turned += turn(heading, direction(outline[f]));
                heading = direction(outline[f]);
            }
            if (f == k) break;
        }
        constexpr double least = 20 * pi / 180;
        if (turned < least || turned > pi + least) continue;
        edges_.push_back({first + i,
                          first + k,
                          {before.to, behind.from},
                          {-direction(before).x, -direction(before).y, 0},
                          std::min(1 + turned / pi, 2.0),
                          std::min(before.height, behind.height),
                          std::max(before.deviation, behind.deviation)});
    }
}

std::optional<WayAround> RayEdges::around(const WallEdge& edge, Vec3 a, Vec3 b) const {
    const Face &before = faces_[edge.before], &behind = faces_[edge.behind];
    const auto corners = corners_seen(edge, before, behind, a, b);
    if (!corners) return std::nullopt;
    const auto [at_a, at_b] = *corners;
    WayAround way{{edge.corners[at_a], edge.corners[at_b]}, {}, 0, 0};
    const double to_edge = distance(flat(a), way.corners[0]);
    const double along = distance(way.corners[0], way.corners[1]);
    const double from_edge = distance(way.corners[1], flat(b));
    const double plan = to_edge + along + from_edge, rise = b.z - a.z;
    if (!(to_edge > 0 && from_edge > 0)) return std::nullopt;
    way.length = std::sqrt(plan * plan + rise * rise);
    way.detour = std::max(0.0, way.length - distance(a, b));
    const double share = (to_edge + along / 2) / plan;
    if (a.z + share * rise > edge.height) return std::nullopt;
    for (std::size_t i = 0; i < 2; ++i)
        way.corners[i].z = a.z + rise * (i == 0 ? to_edge : to_edge + along) / plan;
    RayEdge& e = way.edge;
    e.before = share * way.length;
    e.after = way.length - e.before;
    e.n = edge.n;
    // From that face on which the corner lies: so no rounding takes it behind the face.
    const auto direction_of = [&](Vec3 p, std::size_t corner) {
        const Vec3 from_corner = flat(p) - edge.corners[corner];
        return corner == 0 ? angle(edge.back, from_corner)
                           : edge.n * pi - angle(from_corner, direction(behind));
    };
    e.phi_before = direction_of(a, at_a);
    e.phi_after = direction_of(b, at_b);
    const auto open = [&](double phi) { return phi >= 0 && phi <= edge.n * pi; };
    if (!open(e.phi_before) || !open(e.phi_after)) return std::nullopt;
    e.detour = way.detour;
    const Face& wall = before.length >= behind.length ? before : behind;
    const double straight = distance(a, b);
    e.material = wall.material;
    e.thickness = wall.thickness;
    e.cosine = straight > 0 ? std::abs(dot(b - a, wall.normal)) / straight : 1;
    return way;
}

}  // namespace rovernet
