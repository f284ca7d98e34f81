// SPDX-License-Identifier: MIT
#include "models/propagation/ray_edges.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace rovernet {
namespace {

using std::numbers::pi;

constexpr double in_plane = 1e-9;  // [m] from a face's plane: rounding

Vec3 direction(const Face& f) { return {-f.normal.y, f.normal.x, 0}; }

/// Angle from one direction to another [rad], counter-clockwise, -pi to pi.
double turn(Vec3 from, Vec3 to) { return math::atan2(cross_in_plan(from, to), dot(from, to)); }
/// Counter-clockwise angle between two directions, 0 to 2 pi.
double angle(Vec3 from, Vec3 to) {
    const double a = turn(from, to);
    return a < 0 ? a + 2 * pi : a;
}

/// Corners of an edge that are visible from the two ends of a path around it; of two, the one
/// nearer to the path. Empty if an end sees none.
std::optional<std::pair<std::size_t, std::size_t>> corners_seen(const WallEdge& edge,
                                                                const Face& before,
                                                                const Face& behind, Vec3 a,
                                                                Vec3 b) {
    const Vec3 across = edge.corners[1] - edge.corners[0];
    // Both corners are visible from beyond the line through them, on the side away from the wall.
    const bool several = dot(across, across) > 0;
    const auto sees_both = [&](Vec3 p) {
        return several && cross_in_plan(across, in_plan(p) - edge.corners[0]) <= in_plane;
    };
    const auto corner_of = [&](Vec3 p) -> std::optional<std::size_t> {
        if (before.in_front(p) >= -in_plane) return 0;
        if (behind.in_front(p) >= -in_plane) return 1;
        return std::nullopt;
    };
    const bool free_a = sees_both(a), free_b = sees_both(b);
    auto at_a = corner_of(a), at_b = corner_of(b);
    if (free_a && free_b) {
        const auto by = [&](Vec3 c) { return distance(in_plan(a), c) + distance(c, in_plan(b)); };
        at_a = at_b = by(edge.corners[0]) <= by(edge.corners[1]) ? 0 : 1;
    } else if (free_a) {
        at_a = at_b;
    } else if (free_b) {
        at_b = at_a;
    }
    if (!at_a || !at_b) return std::nullopt;
    return std::pair{*at_a, *at_b};
}

/// Path by two corners of a body on its left, as a pair of edges.
EdgePair pair_of(Vec3 from, Vec3 first, Vec3 last, Vec3 to, double along) {
    const auto bend = [](Vec3 p, Vec3 q, Vec3 r) {
        const double longer = distance(p, q) + distance(q, r) - distance(p, r);
        return std::copysign(std::max(0.0, longer), cross_in_plan(q - p, r - q));
    };
    return {.before = distance(from, first),
            .along = along,
            .after = distance(last, to),
            .first = bend(from, first, last),
            .last = bend(first, last, to)};
}

EdgePair turned_round(const EdgePair& pair) {
    return {pair.after, pair.along, pair.before, pair.last, pair.first};
}

/// Pair of edges for the three-dimensional path, which is longer than the path in plan by a factor.
EdgePair scaled(const EdgePair& pair, double longer) {
    return {pair.before * longer, pair.along * longer, pair.after * longer, pair.first / longer,
            pair.last / longer};
}

void set_wall(RayEdge& edge, const Face& wall, Vec3 a, Vec3 b) {
    const double straight = distance(a, b);
    edge.material = wall.material;
    edge.thickness = wall.thickness;
    edge.cosine = straight > 0 ? std::abs(dot(b - a, wall.normal)) / straight : 1;
}

}  // namespace

RayEdges::RayEdges(std::span<const Face> faces, double wavelength)
    : faces_(faces), wavelength_(wavelength), of_face_(faces.size()) {
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i;
        double longest = 0;
        while (end < faces.size() && faces[end].outline == faces[i].outline)
            longest = std::max(longest, faces[end++].length);
        add_outline(faces.subspan(i, end - i), i, std::min(5 * wavelength, 0.4 * longest));
        i = end;
    }
}

void RayEdges::add_outline(std::span<const Face> outline, std::size_t first, double shortest) {
    std::vector<std::size_t> sides;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (outline[i].length >= shortest) sides.push_back(i);
    const std::size_t first_edge = edges_.size();
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
        edges_.push_back({.before = first + i,
                          .behind = first + k,
                          .corners = {before.to, behind.from},
                          .back = {-direction(before).x, -direction(before).y, 0},
                          .n = std::min(1 + turned / pi, 2.0),
                          .height = std::min(before.height, behind.height),
                          .steps = std::max(before.deviation, behind.deviation),
                          .previous = no_edge,
                          .next = no_edge,
                          .thin = distance(before.to, behind.from) <= wavelength_});
    }
    link_edges(first_edge, outline, first);
}

/// Connects the last edges, those of one outline, with their neighbours and faces.
void RayEdges::link_edges(std::size_t first_edge, std::span<const Face> outline,
                          std::size_t first) {
    for (std::size_t e = first_edge; e < edges_.size(); ++e) {
        of_face_[edges_[e].before].before = e;
        of_face_[edges_[e].behind].behind = e;
        const std::size_t n = outline.size(), end = edges_[e].behind - first;
        for (std::size_t f = (edges_[e].before - first + 1) % n; f != end; f = (f + 1) % n)
            of_face_[first + f].between = e;
    }
    for (std::size_t e = first_edge; e < edges_.size(); ++e) {
        edges_[e].next = of_face_[edges_[e].behind].before;
        edges_[e].previous = of_face_[edges_[e].before].behind;
    }
}

void RayEdges::find_crossed(std::span<const std::size_t> faces,
                            std::vector<CrossedAt>& crossed) const {
    crossed.assign(edges_.size(), {});
    for (const std::size_t face : faces) {
        const EdgesOfFace& of = of_face_[face];
        if (of.before != no_edge) crossed[of.before].before = true;
        if (of.behind != no_edge) crossed[of.behind].behind = true;
        if (of.between != no_edge) crossed[of.between].between = true;
    }
}

std::size_t RayEdges::edge_of(std::size_t f, std::size_t g) const {
    if (of_face_.empty()) return no_edge;
    for (const std::size_t e : {of_face_[f].before, of_face_[f].behind, of_face_[f].between})
        if (e != no_edge && is_of(g, e)) return e;
    return no_edge;
}

std::optional<WayAround> RayEdges::around(std::size_t number, Vec3 a, Vec3 b) const {
    const WallEdge& edge = edges_[number];
    const Face &before = faces_[edge.before], &behind = faces_[edge.behind];
    const auto corners = corners_seen(edge, before, behind, a, b);
    if (!corners) return std::nullopt;
    const auto [at_a, at_b] = *corners;
    WayAround way{{number, number}, {edge.corners[at_a], edge.corners[at_b]}, {}, 0, 0};
    const double to_edge = distance(in_plan(a), way.corners[0]);
    const double along = distance(way.corners[0], way.corners[1]);
    const double from_edge = distance(way.corners[1], in_plan(b));
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
    // Measured from the face that contains the corner, so that rounding cannot put the corner
    // behind it.
    const auto direction_of = [&](Vec3 p, std::size_t corner) {
        const Vec3 from_corner = in_plan(p) - edge.corners[corner];
        const double phi =
            corner == 0 ? angle(edge.back, from_corner) : angle(from_corner, direction(behind));
        // In the plane of the face, rounding may give either side.
        const double from_face = 2 * pi - phi < 1e-6 ? 0 : phi;
        return corner == 0 ? from_face : edge.n * pi - from_face;
    };
    e.phi_before = direction_of(a, at_a);
    e.phi_after = direction_of(b, at_b);
    const auto open = [&](double phi) { return phi >= 0 && phi <= edge.n * pi; };
    if (!open(e.phi_before) || !open(e.phi_after)) return std::nullopt;
    e.detour = way.detour;
    set_wall(e, faces_[wall_at(number)], a, b);
    return way;
}

/// Appends the corners from an edge forward to the edge where the straight path leaves the body;
/// false if that is not reached.
bool RayEdges::corners_past(std::size_t first, std::span<const CrossedAt> crossed,
                            std::vector<EdgeCorner>& out) const {
    constexpr std::size_t most = 16;
    bool whole = crossed[first].before;  // else the way begins between the corners
    for (std::size_t e = first, n = 0; n < most; n += 2) {
        const WallEdge& edge = edges_[e];
        if (whole || edge.thin) out.push_back({edge.corners[0], e});
        if (crossed[e].between && whole && !edge.thin) return true;
        out.push_back({edge.corners[1], e});
        if (crossed[e].behind || (crossed[e].between && whole)) return true;
        whole = true;
        e = edge.next;
        if (e == no_edge || e == first) break;
    }
    return false;
}

std::vector<EdgeCorner> touched(std::span<const EdgeCorner> corners, Vec3 from, Vec3 to) {
    std::vector<EdgeCorner> out;
    const auto add = [&](Vec3 next) {
        while (!out.empty()) {
            const Vec3 last = out.back().at;
            const Vec3 before = out.size() > 1 ? out[out.size() - 2].at : from;
            if (cross_in_plan(last - before, next - last) > 0) return;
            out.pop_back();
        }
    };
    for (const EdgeCorner& corner : corners) {
        add(corner.at);
        out.push_back(corner);
    }
    add(to);
    return out;
}

std::optional<std::size_t> TautString::touches(const EdgeCorner& corner) const {
    for (std::size_t i = 0; i < touched.size(); ++i)
        if (touched[i].edge == corner.edge && distance(touched[i].at, corner.at) == 0) return i;
    return std::nullopt;
}

std::optional<WayAround> RayEdges::around_body(std::size_t first,
                                               std::span<const CrossedAt> crossed, Vec3 a, Vec3 b,
                                               std::vector<EdgeCorner>& corners) const {
    const std::size_t before = corners.size();
    if (!corners_past(first, crossed, corners)) {
        corners.resize(before, EdgeCorner{});
        return std::nullopt;
    }
    // Forward, the body is on the left, and its obstructing corners are on the right of the line.
    double off = 0;  // of the corner that is farthest from the line
    for (const EdgeCorner& corner : std::span(corners).subspan(before)) {
        const double its = cross_in_plan(b - a, corner.at - in_plan(a));
        if (std::abs(its) > std::abs(off)) off = its;
    }
    const bool forward = off < 0;
    const std::vector<EdgeCorner> at = touched(std::span(corners).subspan(before),
                                               in_plan(forward ? a : b), in_plan(forward ? b : a));
    if (at.empty()) return std::nullopt;
    const std::size_t e = at.front().edge;
    const bool one = at.back().edge == e && (at.size() == 1 || edges_[e].thin);
    if (!one) return around_corners(at, a, b, forward);
    auto way = around(e, a, b);
    if (!way) return way;
    way->edge.shadowed = true;
    join_next_corner(*way, e, true, a, b);
    return way;
}

/// @param corners  several, that the way touches
std::optional<WayAround> RayEdges::around_corners(std::span<const EdgeCorner> corners, Vec3 a,
                                                  Vec3 b, bool forward) const {
    const Vec3 from = in_plan(forward ? a : b), to = in_plan(forward ? b : a);
    // The two corners of a thin edge count as one; the inner one counts.
    const auto is_thin = [&](std::size_t i) {
        return corners[i].edge == corners[i + 1].edge && edges_[corners[i].edge].thin;
    };
    const std::size_t end = corners.size() - 1;
    const std::size_t i = end > 1 && is_thin(0) ? 1 : 0;
    const std::size_t k = end > i + 1 && is_thin(end - 1) ? end - 1 : end;
    double along = 0;
    for (std::size_t c = i; c < k; ++c) along += distance(corners[c].at, corners[c + 1].at);
    EdgePair pair = pair_of(from, corners[i].at, corners[k].at, to, along);
    if (!(pair.before > 0 && pair.along > 0 && pair.after > 0)) return std::nullopt;
    if (!forward) pair = turned_round(pair);
    const double plan = pair.before + along + pair.after, rise = b.z - a.z;
    const EdgeCorner &near_a = forward ? corners.front() : corners.back(),
                     &near_b = forward ? corners.back() : corners.front();
    WayAround way{{near_a.edge, near_b.edge}, {near_a.at, near_b.at}, {}, 0, 0};
    way.length = std::sqrt(plan * plan + rise * rise);
    way.detour = std::max(0.0, way.length - distance(a, b));
    double height = std::numeric_limits<double>::infinity();
    std::size_t wall = edges_[corners[0].edge].before;
    for (const EdgeCorner& c : corners) {
        const WallEdge& edge = edges_[c.edge];
        height = std::min(height, edge.height);
        for (const std::size_t face : {edge.before, edge.behind})
            if (faces_[face].length > faces_[wall].length) wall = face;
    }
    way.corners[0].z = a.z + rise * pair.before / plan;
    way.corners[1].z = b.z - rise * pair.after / plan;
    if ((way.corners[0].z + way.corners[1].z) / 2 > height) return std::nullopt;
    way.edge.before = (pair.before + along / 2) / plan * way.length;
    way.edge.after = way.length - way.edge.before;
    way.edge.pair = scaled(pair, way.length / plan);
    way.edge.detour = way.detour;
    way.edge.shadowed = true;
    set_wall(way.edge, faces_[wall], a, b);
    return way;
}

std::size_t RayEdges::join_next_corner(WayAround& way, std::size_t e, bool shadowed, Vec3 a,
                                       Vec3 b) const {
    const WallEdge& edge = edges_[e];
    const Vec3 at = in_plan(way.corners[0]);
    const bool one = distance(at, in_plan(way.corners[1])) == 0;
    if (!one && !edge.thin) return no_edge;
    // Forward, the body is on the left: a lit corner is on the left, an obstructing one is not.
    const double left = cross_in_plan(b - a, at - in_plan(a));
    // For a line through the corner, the direction of the outline there decides.
    const Face &before = faces_[edge.before], &behind = faces_[edge.behind];
    const auto is_in = [&](const Face& face) { return std::abs(face.in_front(a)) <= in_plane; };
    const Vec3 outline = is_in(before)   ? direction(before)
                         : is_in(behind) ? direction(behind)
                                         : direction(before) + direction(behind) +
                                               (edge.corners[1] - edge.corners[0]);
    const bool along = std::abs(left) <= in_plane * distance(a, b);
    const bool forward = along ? dot(b - a, outline) > 0 : (left > 0) != shadowed;
    const Vec3 from = in_plan(forward ? a : b), to = in_plan(forward ? b : a);
    const double stretch = way.length / (distance(from, at) + distance(at, to));
    const std::size_t corner = distance(at, edge.corners[0]) == 0 ? 0 : 1;
    std::size_t joined = no_edge;
    double least = near_edge * wavelength_;
    const auto look = [&](Vec3 first, Vec3 last, bool other_first, std::size_t other) {
        const Vec3 off = other_first ? first - from : to - last;
        const Vec3 leg = other_first ? last - from : to - first;
        if (!(dot(off, leg) > 0 && dot(off, leg) < dot(leg, leg))) return;
        EdgePair pair = pair_of(from, first, last, to, distance(first, last));
        const double detour = std::abs(other_first ? pair.first : pair.last);
        if (!(detour < least && pair.before > 0 && pair.along > 0 && pair.after > 0)) return;
        least = detour;
        joined = other;
        way.edge.pair = scaled(forward ? pair : turned_round(pair), stretch);
    };
    if (!edge.thin && corner == 1)
        look(edge.corners[0], at, true, e);
    else if (edge.previous != no_edge)
        look(edges_[edge.previous].corners[1], edge.corners[0], true, edge.previous);
    if (!edge.thin && corner == 0)
        look(at, edge.corners[1], false, e);
    else if (edge.next != no_edge)
        look(edge.corners[1], edges_[edge.next].corners[0], false, edge.next);
    return joined;
}

}  // namespace rovernet
