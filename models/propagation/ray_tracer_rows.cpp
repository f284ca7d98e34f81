// SPDX-License-Identifier: MIT
#include "models/propagation/edges/edge_row.hpp"
#include "models/propagation/ray_tracer.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

// Paths around the bodies on one side of the straight path: around each body, through or past the
// others; and around several bodies.

namespace rovernet {
namespace {

/// Detour around an edge beside a path [wavelengths] below which the edge affects a row: farther
/// off, the field past an edge is that of free space except for oscillations of 1 dB.
constexpr double felt_edge = 0.5;

}  // namespace

TautString RayTracer::string_around(std::span<const BodyWay* const> bodies, bool left) const {
    TautString out{in_plan(left ? b_ : a_), in_plan(left ? a_ : b_), {}, {0}};
    std::vector<EdgeCorner> corners;
    for (const BodyWay* body : bodies) {
        const auto its = corners_of(*body);
        corners.insert(corners.end(), its.begin(), its.end());
    }
    out.touched = touched(corners, out.from, out.to);
    for (std::size_t i = 0; i <= out.touched.size(); ++i)
        out.at.push_back(out.at.back() + distance(out.point(i), out.point(i + 1)));
    return out;
}

/// Position of a corner along a string, and its distance from the string; empty if it is beside
/// none of its legs.
/// @param body  number of the corner's body
std::optional<RowCorner> RayTracer::beside(const TautString& string, const EdgeCorner& corner,
                                           std::size_t body) const {
    if (const auto k = string.touches(corner)) {
        const Vec3 in = string.point(*k + 1) - string.point(*k),
                   out = string.point(*k + 2) - string.point(*k + 1);
        const double turn = math::atan2(cross_in_plan(in, out), dot(in, out));
        return RowCorner{string.at[*k + 1], 0, std::max(0.0, turn), body};
    }
    std::optional<RowCorner> nearest;
    for (std::size_t leg = 0; leg <= string.touched.size(); ++leg) {
        const Vec3 p = string.point(leg), q = string.point(leg + 1);
        const double length = distance(p, q);
        if (!(length > 0)) continue;
        const Vec3 along = (1 / length) * (q - p);
        const double at = dot(corner.at - p, along), below = cross_in_plan(along, corner.at - p);
        if (at < 0 || at > length) continue;
        if (!nearest || std::abs(below) < std::abs(nearest->below))
            nearest = RowCorner{string.at[leg] + at, below, 0, body};
    }
    return nearest;
}

/// Corners of a body that a path on its side may touch or pass nearby: those of the body's own
/// path, and the next corners of the outline if they are on the same side of the straight path.
std::vector<EdgeCorner> RayTracer::corners_near(const BodyWay& body) const {
    const auto its = corners_of(body);
    const WallEdge &first = edges_.all()[its.front().edge], &last = edges_.all()[its.back().edge];
    const bool side = body.left == body.way.edge.shadowed;
    std::vector<EdgeCorner> out;
    const auto add = [&](Vec3 at, std::size_t edge) {
        const auto is_at = [&](const EdgeCorner& c) { return distance(c.at, at) == 0; };
        if (is_left(at) == side && std::none_of(its.begin(), its.end(), is_at))
            out.push_back({at, edge});
    };
    if (distance(first.corners[0], its.front().at) > 0)
        add(first.corners[0], its.front().edge);
    else if (first.previous != no_edge)
        add(edges_.all()[first.previous].corners[1], first.previous);
    out.insert(out.end(), its.begin(), its.end());
    if (distance(last.corners[1], its.back().at) > 0)
        add(last.corners[1], its.back().edge);
    else if (last.next != no_edge)
        add(edges_.all()[last.next].corners[0], last.next);
    return out;
}

/// Corners of the bodies on one side that a string touches or passes nearby, in its order. Bodies
/// that it crosses have none.
std::vector<RowCorner> RayTracer::row_of(const TautString& string,
                                         std::span<const BodyWay* const> side) const {
    std::vector<RowCorner> row;
    for (std::size_t body = 0; body < side.size(); ++body) {
        const std::size_t first = row.size();
        std::size_t last_edge = no_edge;
        Vec3 last{};
        for (const EdgeCorner& corner : corners_near(*side[body])) {
            if (corner.edge == last_edge && distance(corner.at, last) == 0) continue;
            const auto found = beside(string, corner, body);
            if (!found) continue;
            if (found->below < -1e-9) {  // the string passes through the body
                row.resize(first, RowCorner{});
                break;
            }
            const double before = found->at, behind = string.length() - found->at;
            if (!(before > 0 && behind > 0)) continue;
            const double detour = found->below * found->below / 2 * (1 / before + 1 / behind);
            if (detour >= felt_edge * wavelength_) continue;
            // The two corners of a thin edge count as one.
            if (corner.edge == last_edge && edges_.all()[corner.edge].thin && row.size() > first) {
                RowCorner& one = row.back();
                one.below = std::min(one.below, found->below);
                one.bend += found->bend;
                continue;
            }
            // A corner behind another one along the path is hidden by it.
            if (row.size() > first && found->at <= row.back().at) {
                if (found->below >= row.back().below) continue;
                row.pop_back();
            }
            row.push_back(*found);
            last_edge = corner.edge;
            last = corner.at;
        }
    }
    std::stable_sort(row.begin(), row.end(),
                     [](const RowCorner& p, const RowCorner& q) { return p.at < q.at; });
    return row;
}

/// Edges of a path past a row: one for each body that the string touches, with the field past all
/// of these, and one for each body that it passes, with the effect of that body.
/// @param longer  ratio of the path's length in three dimensions to that in plan
std::vector<RayEdge> RayTracer::edges_past(const TautString& string,
                                           std::span<const BodyWay* const> side,
                                           double longer) const {
    const std::vector<RowCorner> corners = row_of(string, side);
    const EdgeRow row(corners, string.length(), wavelength_ * longer);
    std::vector<char> is_touched(side.size(), false), is_beside(side.size(), false);
    for (const RowCorner& corner : corners) {
        is_touched[corner.body] |= corner.bend > 0;
        is_beside[corner.body] = true;
    }
    std::vector<char> without(side.size());
    for (std::size_t body = 0; body < side.size(); ++body) without[body] = !is_touched[body];
    math::Complex field = row.field_without(without);
    std::vector<RayEdge> edges;
    for (std::size_t body = 0; body < side.size(); ++body) {
        if (!is_touched[body]) continue;
        edges.push_back(side[body]->way.edge);
        edges.back().pair.reset();
        edges.back().field = edges.size() == 1 ? field : 1;
    }
    for (std::size_t body = 0; body < side.size(); ++body) {
        if (is_touched[body] || !is_beside[body]) continue;
        without[body] = false;
        const math::Complex with = row.field_without(without);
        edges.push_back(side[body]->way.edge);
        edges.back().pair.reset();
        edges.back().shadowed = false;
        edges.back().field = math::quotient(with, field);
        field = with;
    }
    return edges;
}

/// Sorts the bodies of a side in the order of the string.
void RayTracer::sort_along(std::vector<const BodyWay*>& side, bool left) const {
    const auto along = [&](const BodyWay* body) {
        return dot(body->way.corners[0] - a_, b_ - a_) * (left ? -1 : 1);
    };
    std::stable_sort(side.begin(), side.end(),
                     [&](const BodyWay* p, const BodyWay* q) { return along(p) < along(q); });
}

/// Adds the paths around the bodies in the straight path on one side: around each of them, around
/// all, and around those with a larger transmission loss than the path around them.
void RayTracer::add_around_bodies(bool left, const RayLimit* limit, RayPaths& out) {
    std::vector<const BodyWay*> side, in_the_way;
    for (const BodyWay& body : bodies_)
        if (body.left == left) side.push_back(&body);
    if (side.size() > 1) sort_along(side, left);
    for (const BodyWay* body : side) {
        if (!body->way.edge.shadowed) continue;
        in_the_way.push_back(body);
        std::vector<RayEdge> others;
        if (side.size() > 1) {
            const TautString string = string_around({&body, 1}, left);
            others = edges_past(string, side, 1);
            std::erase_if(others, [](const RayEdge& edge) { return edge.shadowed; });
        }
        add_around(body->way, others, limit, out);
    }
    if (in_the_way.size() < 2) return;
    std::vector<const BodyWay*> heavy;
    for (const BodyWay* body : in_the_way)
        if (takes_more_than_its_way(*body, limit, out)) heavy.push_back(body);
    const TautString all = string_around(in_the_way, left);
    add_row(all, side, left, limit, out);
    if (heavy.size() < 2 || heavy.size() == in_the_way.size()) return;
    const TautString shorter = string_around(heavy, left);
    if (shorter.length() < all.length()) add_row(shorter, side, left, limit, out);
}

/// Whether crossing a body costs the straight path more than the path around it.
bool RayTracer::takes_more_than_its_way(const BodyWay& body, const RayLimit* limit,
                                        const RayPaths& out) {
    if (!limit) return true;
    const auto corners = corners_of(body);
    double through = 0;
    for (const RayHit& hit : out.hits(out.paths[0]))
        if (hit.face != no_face &&
            edges_.is_at(hit.face, corners.front().edge, corners.back().edge))
            through += loss_of(hit, limit->materials);
    return through >
           limit->materials.around(body.way.edge, limit->diffraction, limit->coherent).loss();
}

/// Adds the path along a string around bodies of a side, if it bends around several.
void RayTracer::add_row(const TautString& string, std::span<const BodyWay* const> side, bool left,
                        const RayLimit* limit, RayPaths& out) {
    const double plan = string.length(), rise = b_.z - a_.z;
    const double length = std::sqrt(plan * plan + rise * rise);
    const std::vector<RayEdge> edges = edges_past(string, side, length / plan);
    const auto bodies =
        std::count_if(edges.begin(), edges.end(), [](const RayEdge& e) { return e.shadowed; });
    if (bodies < 2) return;
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), 0};
    if (limit) draft.loss = free_space(length, limit->frequency);
    for (const RayEdge& edge : edges) bend(edge, draft);
    // From a to b, like all paths.
    const std::size_t legs = string.touched.size() + 1;
    const auto point = [&](std::size_t i) {
        const std::size_t k = left ? legs - i : i;
        Vec3 p = string.point(k);
        p.z = a_.z + rise * (left ? plan - string.at[k] : string.at[k]) / plan;
        return p;
    };
    const auto edge_at = [&](std::size_t i) {
        const std::size_t k = left ? legs - i : i;
        return k == 0 || k == legs ? no_edge : string.touched[k - 1].edge;
    };
    bool bright = !is_faint(draft);
    for (std::size_t i = 0; bright && i < legs; ++i) {
        const std::size_t p = edge_at(i), q = edge_at(i + 1);
        const WallEdge* wall = q == no_edge ? nullptr : &edges_.all()[q];
        if (wall && point(i + 1).z > wall->height) bright = false;
        // Legs along a body are included in the field past it.
        const bool along = p != no_edge && q != no_edge &&
                           (p == q || edges_.all()[p].next == q || edges_.all()[q].next == p);
        if (bright && !along) bright = pass_leg(point(i), p, point(i + 1), q, draft);
    }
    finish(draft, bright, length);
}

}  // namespace rovernet
