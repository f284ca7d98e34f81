// SPDX-License-Identifier: MIT
#include "models/propagation/ray_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// Paths around edges and bodies.

namespace rovernet {

/// Whether the path by one of the edge's corners is longer than the straight path by less than
/// `detour` [m], in plan: the corner lies in an ellipse around both ends.
bool RayTracer::is_near(const WallEdge& edge, double detour) const {
    const Vec3 way = in_plan(b_ - a_);
    const double squared = dot(way, way), length = std::sqrt(squared);
    const double width = detour * (detour + 2 * length) / 4;  // of half the ellipse, squared
    for (const Vec3 corner : edge.corners) {
        const Vec3 off = corner - in_plan(a_);
        const double along = length > 0 ? dot(off, way) / length : 0;
        if (along < -detour / 2 || along > length + detour / 2) continue;
        if (dot(off, off) - along * along <= width) return true;
    }
    return false;
}

/// Whether a point is on the left of the straight path, in plan.
bool RayTracer::is_left(Vec3 p) const { return cross_in_plan(b_ - a_, p - a_) > 0; }

/// Adds the walls whose corners the straight path clips where the drawn outline is cut short, so
/// that the faces' lines intersect outside it. The straight path is the only path so far.
void RayTracer::add_clipped(const RayLimit* limit, RayPaths& out) {
    const Vec3 way = b_ - a_;
    const double length = distance(a_, b_);
    const auto side = [&](Vec3 p) { return cross_in_plan(way, p - a_); };
    for (std::size_t e = 0; e < at_edge_.size(); ++e) {
        const WallEdge& edge = edges_.all()[e];
        if (at_edge_[e].any() || edge.steps == 0 || !is_near(edge, near_edge * wavelength_))
            continue;
        const Face &before = faces_[edge.before], &behind = faces_[edge.behind];
        const double s0 = side(edge.corners[0]), s1 = side(edge.corners[1]);
        const auto crosses = [&](double corner, const Face& face, Vec3 end) {
            return corner * side(end) < 0 && face.in_front(a_) * face.in_front(b_) < 0;
        };
        const bool by_before = crosses(s0, before, before.from),
                   by_behind = crosses(s1, behind, behind.to), between = s0 * s1 < 0;
        if (by_before + by_behind + between != 2) continue;
        const std::size_t face = edges_.wall_at(e);
        const double cosine =
            std::clamp(std::abs(dot(way, faces_[face].normal)) / length, grazing, 1.0);
        const double thickness = faces_[face].thickness;
        const double share =
            std::clamp(dot(edge.corners[0] - a_, way) / (length * length), 0.0, 1.0);
        if (a_.z + share * way.z > edge.height) continue;
        out.all_hits.push_back({RayHit::Kind::crossing, face, faces_[face].material, thickness,
                                cosine, thickness / cosine});
        ++out.paths[0].hits;
        if (limit) losses_[0] += loss_of(out.all_hits.back(), limit->materials);
        at_edge_[e] = {by_before, by_behind, between};
    }
}

/// Adds the paths around edges; the straight path is the only path so far.
void RayTracer::add_diffracted(const RayLimit* limit, RayPaths& out) {
    edges_.find_crossed(crossed_, at_edge_);
    add_clipped(limit, out);
    done_.assign(edges_.all().size(), false);
    bodies_.clear();
    corners_.clear();
    // First bodies that obstruct the path, then other obstructing edges, then edges beside it.
    for (std::size_t e = 0; e < at_edge_.size(); ++e) {
        const CrossedAt& at = at_edge_[e];
        if (!at.before && !at.between) continue;
        const std::size_t first = corners_.size();
        const auto way = edges_.around_body(e, at_edge_, a_, b_, corners_);
        if (!way) {
            corners_.resize(first, EdgeCorner{});
            continue;
        }
        bodies_.push_back({first, corners_.size() - first, *way, is_left(way->corners[0])});
        for (const EdgeCorner& passed : corners_of(bodies_.back())) done_[passed.edge] = true;
    }
    for (std::size_t e = 0; e < at_edge_.size(); ++e)
        if (!done_[e] && !at_edge_[e].any()) pass_beside(e);
    for (const bool left : {false, true}) add_beside(left, limit, out);
    for (std::size_t e = 0; e < at_edge_.size(); ++e)
        if (!done_[e] && at_edge_[e].any()) add_around_edge(e, limit, out);
    for (const bool left : {false, true}) add_around_bodies(left, limit, out);
    if (limit && limit->diffraction == RayDiffraction::knife_edge && out.beside)
        losses_[0] += limit->materials.beside_edge(*out.beside);
    if (limit) best_ = *std::min_element(losses_.begin(), losses_.end());
}

/// Adds the path around an edge that obstructs the straight path, without regard to the rest of its
/// body.
void RayTracer::add_around_edge(std::size_t e, const RayLimit* limit, RayPaths& out) {
    auto way = edges_.around(e, a_, b_);
    if (!way) return;
    way->edge.shadowed = true;
    edges_.join_next_corner(*way, e, true, a_, b_);
    add_around(*way, {}, limit, out);
}

/// Handles a body beside the straight path with an edge near it: the path passes on the edge's lit
/// side, or a second path leads around its far side.
void RayTracer::pass_beside(std::size_t e) {
    const WallEdge& edge = edges_.all()[e];
    const double near = near_edge * wavelength_;
    if (!is_near(edge, near)) return;
    auto way = edges_.around(e, a_, b_);
    if (!way || way->detour >= near) return;
    const double turned = std::abs(way->edge.phi_after - way->edge.phi_before);
    way->edge.shadowed = turned > std::numbers::pi * (1 + 1e-12);
    const std::size_t other = edges_.join_next_corner(*way, e, way->edge.shadowed, a_, b_);
    const std::size_t first = corners_.size();
    const auto add = [&](std::size_t number, std::size_t corner) {
        corners_.push_back({edges_.all()[number].corners[corner], number});
    };
    // The neighbours before and behind may be one edge, the other end of a wall: then the joined
    // corner is the nearer one.
    const bool other_first =
        other != no_edge && other != e && other == edge.previous &&
        (other != edge.next || distance(edges_.all()[other].corners[1], edge.corners[0]) <=
                                   distance(edge.corners[1], edges_.all()[other].corners[0]));
    if (other_first) add(other, 1);
    for (const std::size_t corner : {0UL, 1UL}) add(e, corner);
    if (other != no_edge && other != e && !other_first) add(other, 0);
    if (other != no_edge) done_[other] = true;
    if (other != no_edge && !way->edge.shadowed) {
        const double share = mirrored_share(*way->edge.pair, wavelength_);
        grazed_.push_back({other == edge.next       ? edge.behind
                           : other == edge.previous ? edge.before
                                                    : no_face,
                           other == e ? e : no_edge, share});
    }
    // A wall with a lit corner is on one side of the line, and the path leads along the other side.
    const Vec3 normal = faces_[edge.behind].normal;
    const Vec3 inward = edge.back + Vec3{-normal.y, normal.x, 0};
    const bool left = way->edge.shadowed ? is_left(way->corners[0]) : !is_left(a_ + inward);
    bodies_.push_back({first, corners_.size() - first, *way, left});
}

/// Adds the effect of the bodies on one side of the straight path to it.
void RayTracer::add_beside(bool left, const RayLimit* limit, RayPaths& out) {
    std::vector<const BodyWay*> lit;
    for (const BodyWay& body : bodies_)
        if (body.left == left && !body.way.edge.shadowed) lit.push_back(&body);
    std::vector<RayEdge> row;
    if (lit.size() > 1) {
        sort_along(lit, left);
        row = edges_past(string_around({}, left), lit, 1);
    }
    if (row.size() < 2) {
        for (const BodyWay* body : lit) {
            const WayAround& way = body->way;
            if (!out.beside || way.detour < out.beside->detour) out.beside = way.edge;
            if (!limit || limit->diffraction == RayDiffraction::utd)
                follow(out.paths[0], way, limit, out);
        }
        return;
    }
    RayPath& straight = out.paths[0];
    // The edges of a path must be consecutive: those of the other side move behind the later ones.
    if (straight.first_edge + straight.edges != out.all_edges.size()) {
        const auto its = out.edges(straight);
        const std::vector<RayEdge> kept(its.begin(), its.end());
        straight.first_edge = out.all_edges.size();
        out.all_edges.insert(out.all_edges.end(), kept.begin(), kept.end());
    }
    for (const RayEdge& edge : row) {
        out.all_edges.push_back(edge);
        ++straight.edges;
        if (limit)
            losses_[0] += limit->materials.around(edge, limit->diffraction, limit->coherent).loss();
    }
}

/// Adds the path around one body, with the walls that it crosses.
/// @param beside  other bodies that the path passes
void RayTracer::add_around(const WayAround& way, std::span<const RayEdge> beside,
                           const RayLimit* limit, RayPaths& out) {
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), 0};
    if (limit) draft.loss = free_space(way.length, limit->frequency);
    bend(way.edge, draft);
    for (const RayEdge& edge : beside) bend(edge, draft);
    const bool bright = !is_faint(draft) &&
                        pass_leg(a_, no_edge, way.corners[0], way.edges[0], draft) &&
                        pass_leg(way.corners[1], way.edges[1], b_, no_edge, draft);
    finish(draft, bright, way.length);
}

/// Adds an edge to a path.
void RayTracer::bend(const RayEdge& edge, Draft& draft) {
    draft.out.all_edges.push_back(edge);
    if (const RayLimit* limit = draft.limit)
        draft.loss += limit->materials.around(edge, limit->diffraction, limit->coherent).loss();
}

/// Adds the effect of an edge beside the straight path on its field; this path crosses the same
/// walls.
void RayTracer::follow(const RayPath& straight, const WayAround& way, const RayLimit* limit,
                       RayPaths& out) {
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), 0};
    if (limit) draft.loss = free_space(way.length, limit->frequency);
    bend(way.edge, draft);
    for (std::size_t i = 0; i < straight.hits; ++i) {
        const RayHit hit = out.all_hits[straight.first_hit + i];
        out.all_hits.push_back(hit);
        if (limit) draft.loss += loss_of(hit, limit->materials);
    }
    finish(draft, !is_faint(draft), way.length);
}

/// Appends the walls that a leg crosses, which may begin and end at edges; false if the path
/// becomes too weak.
bool RayTracer::pass_leg(Vec3 p, std::size_t at_p, Vec3 q, std::size_t at_q, Draft& draft) {
    draft.beside = {at_p, at_q};
    return pass(p, q, 0, 0, draft);
}

}  // namespace rovernet
