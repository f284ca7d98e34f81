// SPDX-License-Identifier: MIT
#include "models/propagation/ray_tracer.hpp"

#include "models/propagation/friis.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rovernet {
namespace {

constexpr double touching = 1e-9;  // [m]

bool is_first(Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) <= std::tie(b.x, b.y, b.z); }

/// Nearest multiple of a step that is a power of two. A path meets the walls of a room at few
/// angles; rounding keeps their number small.
double rounded(double x, double step) { return std::floor(x / step + 0.5) * step; }
double cosine_of(double x) { return rounded(std::clamp(std::abs(x), grazing, 1.0), 0x1p-36); }
double thickness_of(double x) { return rounded(std::max(x, 0.0), 0x1p-34); }

/// Length of the part of a leg from p to q that runs among the outline steps of a slanting face at
/// one end [m].
double among_steps(const Face& face, Vec3 p, Vec3 q) {
    if (face.deviation == 0) return 0;
    const double leaving = std::abs(dot(q - p, face.normal));
    return leaving > 0 ? face.deviation / leaving * distance(p, q)
                       : std::numeric_limits<double>::infinity();
}

}  // namespace

RayTracer::RayTracer(const Scene& scene, Vec3 from, int order, double wavelength, bool edges,
                     bool few)
    : scene_(scene), from_(from), wavelength_(wavelength) {
    if (!scene.faces()) return;
    faces_ = scene.faces()->all();
    images_ = RayImages(faces_, from, order, wavelength, few);
    if (!edges) return;
    edges_ = RayEdges(faces_, wavelength);
}

void RayTracer::trace(Vec3 to, const RayLimit* limit, RayPaths& out) {
    out.clear();
    losses_.clear();
    const bool forward = is_first(from_, to);
    a_ = forward ? from_ : to;
    b_ = forward ? to : from_;
    best_ = std::numeric_limits<double>::infinity();
    points_.clear();
    reflections_.clear();
    grazed_.clear();
    add(*plan({}, limit), limit, out);
    if (!edges_.all().empty()) add_diffracted(limit, out);
    propose(to, limit);
    for (const Candidate& c : candidates_) {
        if (limit && c.least_loss > best_ + limit->faintest) break;
        add(c, limit, out);
    }
    if (!limit) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < losses_.size(); ++i) {
        if (losses_[i] > best_ + limit->faintest) continue;
        losses_[kept] = losses_[i];
        out.paths[kept++] = out.paths[i];
    }
    losses_.resize(kept);
    out.paths.resize(kept);
}

/// Collects the existing paths among those that the images propose, strongest first as far as
/// known, in an order that is the same in both directions.
void RayTracer::propose(Vec3 to, const RayLimit* limit) {
    candidates_.clear();
    const bool forward = a_ == from_;
    images_.seen_from(to, [&](std::span<const std::uint32_t> chain) {
        chain_.assign(chain.begin(), chain.end());
        if (forward) std::reverse(chain_.begin(), chain_.end());
        if (const auto candidate = plan(chain_, limit)) candidates_.push_back(*candidate);
    });
    std::sort(candidates_.begin(), candidates_.end(), [&](const Candidate& p, const Candidate& q) {
        if (p.least_loss != q.least_loss) return p.least_loss < q.least_loss;
        if (p.count != q.count) return p.count < q.count;
        return std::ranges::lexicographical_compare(reflections_of(p), reflections_of(q), {},
                                                    &RayHit::face, &RayHit::face);
    });
}

/// Computes the path by these faces; empty if it does not exist.
std::optional<RayTracer::Candidate> RayTracer::plan(std::span<const std::uint32_t> chain,
                                                    const RayLimit* limit) {
    mirrored_.assign(1, in_plan(a_));
    for (const std::uint32_t number : chain) {
        const Face& face = faces_[number];
        const double before = face.in_front(mirrored_.back());
        if (!(before > 0)) return std::nullopt;
        mirrored_.push_back(mirrored_.back() - 2 * before * face.normal);
    }
    const double flat = distance(mirrored_.back(), in_plan(b_)), rise = b_.z - a_.z;
    Candidate path{.length = std::sqrt(flat * flat + rise * rise),
                   .first_point = points_.size(),
                   .first = reflections_.size(),
                   .count = chain.size()};
    points_.resize(path.first_point + chain.size() + 2, b_);
    const auto points = std::span(points_).subspan(path.first_point);
    if (!place(chain, flat, points)) {
        points_.resize(path.first_point);
        return std::nullopt;
    }
    if (limit) path.free_space = path.least_loss = free_space(path.length, limit->frequency);
    for (std::size_t k = 0; k < chain.size(); ++k) {
        reflections_.push_back(reflection(points[k], points[k + 1], chain[k]));
        const RayHit& hit = reflections_.back();
        if (limit)
            path.least_loss += limit->materials.least_reflection_loss(hit.material, hit.cosine);
    }
    return path;
}

/// Computes all points of a path except the last, backwards from the last; false if a point is not
/// on its face.
/// @param flat  length of the path in plan [m]
bool RayTracer::place(std::span<const std::uint32_t> chain, double flat,
                      std::span<Vec3> points) const {
    const double rise = b_.z - a_.z;
    double left = flat;  // of the way in plan, from b back
    for (std::size_t k = chain.size(); k > 0; --k) {
        const Face& face = faces_[chain[k - 1]];
        const Vec3 p = points[k + 1];
        const double front = face.in_front(p), behind = -face.in_front(mirrored_[k]);
        if (!(front > 0)) return false;
        const Vec3 way = mirrored_[k] - in_plan(p);
        Vec3 at = in_plan(p) + (front / (front + behind)) * way;
        const double along = dot(at - face.from, face.to - face.from);
        if (along < 0 || along > face.length * face.length) return false;
        left -= distance(in_plan(p), at);
        at.z = a_.z + rise * (left / flat);
        if (at.z > face.height) return false;
        points[k] = at;
    }
    points[0] = a_;
    return true;
}

/// Adds the path with the walls that it crosses, unless it is too weak.
void RayTracer::add(const Candidate& path, const RayLimit* limit, RayPaths& out) {
    Draft draft{out, limit, out.all_hits.size(), out.all_edges.size(), path.free_space};
    draft.whole_ends = path.count == 0;
    const auto reflections = reflections_of(path);
    const auto points = std::span(points_).subspan(path.first_point, path.count + 2);
    for (const RayHit& hit : reflections)
        if (limit) draft.loss += loss_of(hit, limit->materials);
    // The reflection by a grazed face is part of the field of the face's edges.
    for (const GrazedFace& grazed : grazed_)
        if (path.count == 1 &&
            (reflections[0].face == grazed.face ||
             (grazed.edge != no_edge && edges_.edge_with(reflections[0].face) == grazed.edge)))
            draft.loss -= 20 * math::log10(std::max(1e-10, 1 - grazed.share));
    bool bright = !is_faint(draft);
    for (std::size_t leg = 0; bright && leg <= path.count; ++leg) {
        const Vec3 p = points[leg], q = points[leg + 1];
        double begin = 0, end = 0;
        if (leg > 0) {
            out.all_hits.push_back(reflections[leg - 1]);
            begin = among_steps(faces_[reflections[leg - 1].face], p, q);
        }
        if (leg < path.count) end = among_steps(faces_[reflections[leg].face], p, q);
        bright = pass(p, q, begin, end, draft);
    }
    finish(draft, bright, path.length);
}

double RayTracer::free_space(double length, Hertz f) {
    return std::max(0.0, free_space_db(length, f));
}

bool RayTracer::is_faint(const Draft& draft) const {
    return draft.limit && draft.loss > best_ + draft.limit->faintest;
}

/// Adds the path with its collected hits and edges to the result, or discards them.
void RayTracer::finish(const Draft& draft, bool bright, double length) {
    std::vector<RayHit>& hits = draft.out.all_hits;
    std::vector<RayEdge>& edges = draft.out.all_edges;
    if (!bright) {
        hits.resize(draft.first);
        edges.resize(draft.first_edge, RayEdge{});
        return;
    }
    if (draft.limit) losses_.push_back(draft.loss);
    best_ = std::min(best_, draft.loss);
    draft.out.paths.push_back({length, draft.first, hits.size() - draft.first, draft.first_edge,
                               edges.size() - draft.first_edge});
}

/// Loss of a hit [dB]; results for a few slabs are cached.
double RayTracer::loss_of(const RayHit& hit, const RayMaterials& materials) {
    if (!materials.is_slab(hit.material)) return materials.factor(hit).loss();
    const auto is_this = [&](const KnownSlab& known) {
        return known.cosine == hit.cosine && known.thickness == hit.thickness &&
               known.material == hit.material;
    };
    auto known = std::find_if(known_.begin(), known_.end(), is_this);
    if (known == known_.end()) {
        known = known_.begin() + static_cast<std::ptrdiff_t>(next_known_++ % known_.size());
        *known = {hit.material, hit.thickness, hit.cosine,
                  materials.losses_at_slab(hit.material, hit.thickness, hit.cosine)};
    }
    return hit.kind == RayHit::Kind::reflection ? known->losses.reflection : known->losses.crossing;
}

/// Reflection by a face of a ray from p to q.
RayHit RayTracer::reflection(Vec3 p, Vec3 q, std::uint32_t number) const {
    const Face& face = faces_[number];
    const double length = distance(q, p);
    const double cosine = length > 0 ? std::abs(dot(q - p, face.normal)) / length : 1;
    return {RayHit::Kind::reflection, number, face.material, thickness_of(face.thickness),
            cosine_of(cosine),        0};
}

/// Appends the walls that a leg crosses, except within its first `begin` and last `end` metres;
/// false if the path becomes too weak.
bool RayTracer::pass(Vec3 p, Vec3 q, double begin, double end, Draft& draft) {
    crossed_.clear();
    scene_.crossings(p, q, crossings_);
    if (crossings_.empty()) return true;
    const double length = distance(p, q);
    const Vec3 along = (1 / length) * (q - p);
    for (Crossing c : crossings_) {
        const bool cut = c.entry < begin || c.exit > length - end;
        c.entry = std::max(c.entry, begin);
        c.exit = std::min(c.exit, length - end);
        if (c.exit - c.entry <= touching) continue;
        if (cut) c.length = c.exit - c.entry;
        const auto hit = crossing(c, p, along, draft);
        if (!hit) continue;
        draft.out.all_hits.push_back(*hit);
        if (!draft.limit) continue;
        draft.loss += loss_of(*hit, draft.limit->materials);
        if (is_faint(draft)) return false;
    }
    return true;
}

/// Whether a line passes through the corner at which the lines of two faces intersect, and not
/// beside it, where only the drawn outline may stick out.
bool RayTracer::is_clipped(std::size_t entry, std::size_t exit, Vec3 from, Vec3 along) const {
    const Face &f = faces_[entry], &g = faces_[exit];
    const double in = -dot(along, f.normal), out = dot(along, g.normal);
    if (!(in > 0 && out > 0)) return true;
    return f.in_front(from) / in < -g.in_front(from) / out;
}

/// Wall of a crossing, by its faces; empty if the path only touches the steps of faces.
std::optional<RayHit> RayTracer::crossing(const Crossing& c, Vec3 from, Vec3 along, Draft& draft) {
    const auto entry = scene_.faces()->at(from + c.entry * along, c.material);
    const auto exit = scene_.faces()->at(from + c.exit * along, c.material);
    RayHit hit{RayHit::Kind::crossing, no_face, c.material, c.length, 1, c.length};
    if (!entry && !exit) return hit;
    if (entry == exit) return std::nullopt;
    for (const std::size_t e : draft.beside)
        if (e != no_edge && (!entry || edges_.is_of(*entry, e)) &&
            (!exit || edges_.is_of(*exit, e)))
            return std::nullopt;
    const std::size_t corner = entry && exit ? edges_.edge_of(*entry, *exit) : no_edge;
    if (corner != no_edge && !is_clipped(*entry, *exit, from, along)) return std::nullopt;
    // A drawn outline may be clipped twice at one corner.
    if (corner != no_edge && draft.whole_ends) {
        if (corner == draft.clipped) return std::nullopt;
        draft.clipped = corner;
    }
    for (const auto& face : {entry, exit})
        if (face) crossed_.push_back(*face);
    // The direction of a wall is more accurate from its long side than from its end.
    const auto longer = [&](std::size_t f, std::size_t g) {
        return std::tie(faces_[f].length, g) > std::tie(faces_[g].length, f);
    };
    hit.face = !exit || (entry && longer(*entry, *exit)) ? *entry : *exit;
    const bool whole = draft.whole_ends && corner != no_edge;
    if (whole) hit.face = edges_.wall_at(corner);
    const Face& face = faces_[hit.face];
    hit.cosine = cosine_of(dot(along, face.normal));
    hit.thickness = thickness_of(c.length * hit.cosine);
    if (!whole && entry && exit && faces_[*entry].opposite(faces_[*exit])) {
        const Vec3 middle = from + ((c.entry + c.exit) / 2) * along;
        hit.thickness =
            thickness_of(-faces_[*entry].in_front(middle) - faces_[*exit].in_front(middle));
    } else if (whole) {
        hit.thickness = thickness_of(face.thickness);
    }
    return hit;
}

}  // namespace rovernet
