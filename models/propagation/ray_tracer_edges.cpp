// SPDX-License-Identifier: MIT
#include "models/propagation/ray_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

// Ways around edges and bodies.

namespace rovernet {

/// A way by one of the edge's corners is longer than the straight path by less than this [m], in
/// plan: the corner lies in an ellipse around both ends, or beside it.
bool RayTracer::is_near(const WallEdge& edge, double detour) const {
    const Vec3 way = Vec3{b_.x - a_.x, b_.y - a_.y, 0};
    const double squared = dot(way, way), length = std::sqrt(squared);
    const double width = detour * (detour + 2 * length) / 4;  // of half the ellipse, squared
    for (const Vec3 corner : edge.corners) {
        const Vec3 off = corner - Vec3{a_.x, a_.y, 0};
        const double along = length > 0 ? dot(off, way) / length : 0;
        if (along < -detour / 2 || along > length + detour / 2) continue;
        if (dot(off, off) - along * along <= width) return true;
    }
    return false;
}

/// Adds the ways around edges; the straight path is the only one so far.
void RayTracer::add_diffracted(const RayLimit* limit, RayPaths& out) {
    edges_.find_crossed(crossed_, at_edge_);
    done_.assign(edges_.all().size(), false);
    bodies_.clear();
    // Bodies in the way, then what is left of the edges in the way, then edges beside it.
    for (std::size_t e = 0; e < at_edge_.size(); ++e) {
        const CrossedAt& at = at_edge_[e];
        if (!at.before && !at.between) continue;
        passed_.clear();
        const auto way = edges_.around_body(e, at_edge_, a_, b_, passed_);
        if (!way) {
            add_around_edge(e, limit, out);
            done_[e] = true;
            continue;
        }
        for (const std::size_t passed : passed_) done_[passed] = true;
        const Vec3 corner = way->corners[0];
        const double left = (b_.x - a_.x) * (corner.y - a_.y) - (b_.y - a_.y) * (corner.x - a_.x);
        bodies_.push_back({passed_.front(), passed_.back(), *way, left > 0});
        add_around(*way, edges_.all()[e].steps, limit, out);
    }
    for (std::size_t e = 0; e < at_edge_.size(); ++e) {
        if (done_[e]) continue;
        if (at_edge_[e].any())
            add_around_edge(e, limit, out);
        else
            pass_beside(e, limit, out);
    }
    for (const bool left : {false, true}) add_around_bodies(left, limit, out);
    if (limit && limit->diffraction == RayDiffraction::knife_edge && out.beside)
        losses_[0] += limit->materials.beside_edge(*out.beside);
    if (limit) best_ = *std::min_element(losses_.begin(), losses_.end());
}

/// Adds the way around an edge in the straight path, whatever else of its body is in the way.
void RayTracer::add_around_edge(std::size_t e, const RayLimit* limit, RayPaths& out) {
    auto way = edges_.around(edges_.all()[e], a_, b_);
    if (!way) return;
    way->edge.shadowed = true;
    edges_.join_next_corner(*way, e, true, a_, b_);
    add_around(*way, edges_.all()[e].steps, limit, out);
}

/// The straight path as it passes an edge that does not stand in its way.
void RayTracer::pass_beside(std::size_t e, const RayLimit* limit, RayPaths& out) {
    const WallEdge& edge = edges_.all()[e];
    const double near = near_edge * wavelength_;
    if (!is_near(edge, near)) return;
    auto way = edges_.around(edge, a_, b_);
    if (!way || way->detour >= near) return;
    const std::size_t other = edges_.join_next_corner(*way, e, false, a_, b_);
    if (other != no_edge) {
        done_[other] = true;
        const double share = mirrored_share(*way->edge.pair, wavelength_);
        grazed_.push_back({other == edge.next       ? edge.behind
                           : other == edge.previous ? edge.before
                                                    : no_face,
                           other == e ? e : no_edge, share});
    }
    if (!out.beside || way->detour < out.beside->detour) out.beside = way->edge;
    if (!limit || limit->diffraction == RayDiffraction::utd)
        add_around(*way, edge.steps, limit, out);
}

void RayTracer::add_around(const WayAround& way, double steps, const RayLimit* limit,
                           RayPaths& out) {
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), 0};
    out.all_edges.push_back(way.edge);
    if (limit)
        draft.loss = free_space(way.length, limit->frequency) +
                     limit->materials.around(way.edge, limit->diffraction, limit->coherent).loss();
    // The drawn outline may stick out of the faces near the corner, as far as their lines meet.
    const double skipped = 3 * steps;
    const bool bright = !is_faint(draft) && pass(a_, way.corners[0], 0, skipped, draft) &&
                        pass(way.corners[1], b_, skipped, 0, draft);
    finish(draft, bright, way.length);
}

/// Adds the path that goes around each body in the straight path, on one side of all, that takes
/// less so than by passing through it; if they are several. As Epstein and Peterson have it, each
/// is gone around from the body before it to the one behind it.
void RayTracer::add_around_bodies(bool left, const RayLimit* limit, RayPaths& out) {
    const RayPath straight = out.paths[0];
    const auto hit = [&](std::size_t i) { return out.all_hits[straight.first_hit + i]; };
    const auto loss_around = [&](const WayAround& way) {
        return limit->materials.around(way.edge, limit->diffraction, limit->coherent).loss();
    };
    std::vector<char> passed(straight.hits, false);  // hits that are gone around
    std::vector<const BodyWay*> row;
    for (const BodyWay& body : bodies_) {
        if (body.left != left) continue;
        const auto is_its = [&](std::size_t i) {
            return !passed[i] && hit(i).face != no_face &&
                   edges_.is_at(hit(i).face, body.first, body.last);
        };
        double through = 0;
        for (std::size_t i = 0; i < straight.hits; ++i)
            if (is_its(i))
                through += limit ? loss_of(hit(i), limit->materials)
                                 : std::numeric_limits<double>::infinity();
        if (through <= (limit ? loss_around(body.way) : 0)) continue;
        for (std::size_t i = 0; i < straight.hits; ++i) passed[i] |= is_its(i);
        row.push_back(&body);
    }
    if (row.size() < 2) return;
    const auto along = [&](const BodyWay* body) { return dot(body->way.corners[0] - a_, b_ - a_); };
    std::sort(row.begin(), row.end(),
              [&](const BodyWay* p, const BodyWay* q) { return along(p) < along(q); });
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), 0};
    double length = 0;
    Vec3 at = a_;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto& corners = row[i]->way.corners;
        const Vec3 next = i + 1 < row.size() ? row[i + 1]->way.corners[0] : b_;
        length += distance(at, corners[0]) + distance(corners[0], corners[1]);
        passed_.clear();
        auto way = edges_.around_body(row[i]->first, at_edge_, at, next, passed_);
        at = corners[1];
        if (!way) continue;
        way->edge.shadowed = true;
        out.all_edges.push_back(way->edge);
        if (limit) draft.loss += loss_around(*way);
    }
    length += distance(at, b_);
    for (std::size_t i = 0; i < straight.hits; ++i) {
        if (passed[i]) continue;
        const RayHit kept = hit(i);
        out.all_hits.push_back(kept);
        if (limit) draft.loss += loss_of(kept, limit->materials);
    }
    if (limit) draft.loss += free_space(length, limit->frequency);
    finish(draft, !is_faint(draft), length);
}

}  // namespace rovernet
