// SPDX-License-Identifier: MIT
#include "models/links/wall_passages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double corners_per_tile = 4;
/// Tolerance for roots: fraction of a segment by which they may lie beyond its ends.
constexpr double beyond = 1e-6;

double cross(Vec3 p, Vec3 q) { return p.x * q.y - p.y * q.x; }

Vec3 cross_3d(Vec3 p, Vec3 q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

Vec3 flat(Vec3 p) { return {p.x, p.y, 0}; }

/// Whether a point at this fraction lies within the segment.
bool within(double share) { return share >= -beyond && share <= 1 + beyond; }

struct Interval {
    double low = infinity;
    double high = -infinity;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

struct Box {
    Interval x = {};
    Interval y = {};
    void add(Vec3 p) {
        x.add(p.x);
        y.add(p.y);
    }
    bool meets(const Box& other) const {
        return x.low <= other.x.high && other.x.low <= x.high && y.low <= other.y.high &&
               other.y.low <= y.high;
    }
};

Box box_of(const std::array<Vec3, 4>& corners) {
    Box box;
    for (const Vec3 p : corners) box.add(p);
    return box;
}

/// Visits the real roots of a t^2 + b t + c. Two roots that rounding may have merged count as one,
/// so that a line of sight which just touches is not missed.
template <class Visit>
void visit_roots(double a, double b, double c, Visit visit) {
    constexpr double noise = 1e-9;
    const double square = b * b, product = 4 * a * c;
    const double discriminant = square - product;
    if (discriminant < -noise * (square + std::abs(product))) return;
    const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
    if (a != 0) visit(q / a);
    if (q != 0) visit(c / q);
}

/// Intersection of the segments p0-p1 and q0-q1; empty if they are parallel or do not intersect.
std::optional<Vec3> meeting_point(Vec3 p0, Vec3 p1, Vec3 q0, Vec3 q1) {
    const Vec3 p = p1 - p0, q = q1 - q0, between = q0 - p0;
    const double turn = cross(p, q);
    const double s = cross(between, q) / turn, t = cross(between, p) / turn;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return std::nullopt;
    return p0 + s * p;
}

void add_meeting_points(const WallRectangle& p, const WallRectangle& q, std::vector<Vec3>& out) {
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            if (const auto point = meeting_point(p.corners[i], p.corners[(i + 1) % 4], q.corners[j],
                                                 q.corners[(j + 1) % 4]))
                out.push_back(*point);
}

/// Rectangles of one material on several maps may overlap, and then count as one wall.
void add_meeting_points(const std::vector<WallRectangle>& rectangles, std::vector<Vec3>& out) {
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (const WallRectangle& r : rectangles) boxes.push_back({box_of(r.corners), boxes.size()});
    std::sort(boxes.begin(), boxes.end(), [](const auto& p, const auto& q) {
        return std::tie(p.first.x.low, p.second) < std::tie(q.first.x.low, q.second);
    });
    for (auto p = boxes.begin(); p != boxes.end(); ++p)
        for (auto q = p + 1; q != boxes.end() && q->first.x.low <= p->first.x.high; ++q)
            if (p->first.meets(q->first) &&
                rectangles[p->second].material == rectangles[q->second].material)
                add_meeting_points(rectangles[p->second], rectangles[q->second], out);
}

/// Limits first ... last [s] to the times at which start + t speed lies in low ... high.
void clip(double start, double speed, double low, double high, double& first, double& last) {
    if (speed == 0) {
        if (!(start >= low && start <= high)) last = -infinity;
        return;
    }
    const double at_low = (low - start) / speed, at_high = (high - start) / speed;
    first = std::max(first, std::min(at_low, at_high));
    last = std::min(last, std::max(at_low, at_high));
}

}  // namespace

/// Moving line of sight, and the area that it sweeps.
struct WallPassages::Sight {
    StraightMotion a, b;
    double duration;
    std::array<Vec3, 4> ends;

    Sight(const StraightMotion& one, const StraightMotion& other, double time)
        : a(one),
          b(other),
          duration(time),
          ends{one.at(0), one.at(time), other.at(0), other.at(time)} {}

    bool holds(double t) const { return t > 0 && t < duration; }

    /// Range of x that it sweeps where y is in `slab`, from the convex hull of its ends.
    Interval x_range(Interval slab) const {
        Interval x;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) {
                const Vec3 p = ends[i], step = ends[j] - ends[i];
                double from = 0, to = 1;
                clip(p.y, step.y, slab.low, slab.high, from, to);
                if (!(from <= to)) continue;
                x.add(p.x + from * step.x);
                x.add(p.x + to * step.x);
            }
        return x;
    }

    /// Visits the times at which the line through both ends passes over a point of the map.
    template <class Visit>
    void visit_passages(Vec3 corner, Visit visit) const {
        const Vec3 w = corner - a.from, span = b.from - a.from, turn = b.velocity - a.velocity;
        visit_roots(-cross(a.velocity, turn), cross(w, turn) - cross(a.velocity, span),
                    cross(w, span), [&](double t) {
                        if (!holds(t)) return;
                        const Vec3 p = a.at(t), along = flat(b.at(t) - p);
                        const double squared = dot(along, along);
                        if (within(dot(corner - p, along) / squared) || squared == 0) visit(t);
                    });
    }

    /// Visits the times at which the line of sight passes the horizontal edge e0-e1.
    template <class Visit>
    void visit_edge(Vec3 e0, Vec3 e1, Visit visit) const {
        const Vec3 edge = e1 - e0, a0 = a.from - e0, b0 = b.from - e0;
        const Vec3 va = a.velocity, vb = b.velocity;
        visit_roots(dot(edge, cross_3d(va, vb)), dot(edge, cross_3d(a0, vb) + cross_3d(va, b0)),
                    dot(edge, cross_3d(a0, b0)), [&](double t) {
                        if (!holds(t)) return;
                        const Vec3 p = a.at(t), along = b.at(t) - p;
                        const double share = (e0.z - p.z) / along.z;
                        if (!within(share)) return;
                        const Vec3 at_top = p + share * along;
                        if (within(dot(at_top - e0, edge) / dot(edge, edge))) visit(t);
                    });
    }
};

WallPassages::WallPassages(const Scene& scene) : scene_(&scene) {
    const auto rectangles = scene.wall_rectangles();
    collect(rectangles);
    for (const WallRectangle& r : rectangles)
        for (const double height : {r.bottom, r.top}) {
            if (!std::isfinite(height)) continue;
            End end{r.corners};
            for (Vec3& p : end.corners) p.z = height;
            ends_.push_back(end);
            levels_.push_back(height);
        }
    for (std::size_t i = 1; i < scene.storeys().size(); ++i)
        levels_.push_back(scene.storeys().floor(i));
    std::sort(levels_.begin(), levels_.end());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
    feet_.push_back(levels_.empty() ? 0 : levels_.front() - 1);
    for (std::size_t i = 1; i < scene.storeys().size(); ++i)
        feet_.push_back(scene.storeys().floor(i));
}

void WallPassages::collect(const std::vector<WallRectangle>& rectangles) {
    if (rectangles.empty()) return;
    for (const WallRectangle& r : rectangles)
        for (const Vec3 p : r.corners) corners_.push_back(flat(p));
    add_meeting_points(rectangles, corners_);
    std::sort(corners_.begin(), corners_.end(),
              [](Vec3 p, Vec3 q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); });
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    sort_into_tiles();
}

void WallPassages::sort_into_tiles() {
    Box box;
    for (const Vec3 p : corners_) box.add(p);
    const double width = box.x.high - box.x.low, height = box.y.high - box.y.low;
    const auto n = static_cast<double>(corners_.size());
    // For any shape of the map there are at most a few tiles per corner.
    tile_ = std::max({std::sqrt(width * height * corners_per_tile / n), std::max(width, height) / n,
                      std::numeric_limits<double>::min()});
    low_ = {box.x.low, box.y.low, 0};
    columns_ = static_cast<int>(width / tile_) + 1;
    rows_ = static_cast<int>(height / tile_) + 1;
    const auto tile_of = [&](Vec3 p) {
        const auto column = static_cast<std::size_t>((p.x - low_.x) / tile_);
        const auto row = static_cast<std::size_t>((p.y - low_.y) / tile_);
        return row * static_cast<std::size_t>(columns_) + column;
    };
    std::stable_sort(corners_.begin(), corners_.end(),
                     [&](Vec3 p, Vec3 q) { return tile_of(p) < tile_of(q); });
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const Vec3 p : corners_) ++first_[tile_of(p) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

void WallPassages::times(const StraightMotion& a, const StraightMotion& b, double duration,
                         std::vector<double>& out) const {
    if (empty()) return;
    const Sight sight(a, b, duration);
    pass_corners(sight, out);
    for (const double z : feet_) {
        pass_edges(a, z, duration, out);
        pass_edges(b, z, duration, out);
    }
    pass_levels(sight, out);
}

void WallPassages::pass_corners(const Sight& sight, std::vector<double>& out) const {
    if (corners_.empty()) return;
    const double margin = beyond * tile_;
    const auto tile_at = [&](double offset, int tiles) {
        return static_cast<int>(std::clamp(std::floor(offset / tile_), 0.0, tiles - 1.0));
    };
    Interval y = box_of(sight.ends).y;
    const int last_row = tile_at(y.high + margin - low_.y, rows_);
    for (int row = tile_at(y.low - margin - low_.y, rows_); row <= last_row; ++row) {
        const Interval x =
            sight.x_range({low_.y + row * tile_ - margin, low_.y + (row + 1) * tile_ + margin});
        if (!(x.low <= low_.x + columns_ * tile_ && x.high >= low_.x)) continue;
        const auto begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
        const int from = tile_at(x.low - margin - low_.x, columns_);
        const int to = tile_at(x.high + margin - low_.x, columns_);
        const std::size_t end = first_[begin + static_cast<std::size_t>(to) + 1];
        for (std::size_t i = first_[begin + static_cast<std::size_t>(from)]; i < end; ++i)
            sight.visit_passages(corners_[i], [&](double t) { out.push_back(t); });
    }
}

void WallPassages::pass_edges(const StraightMotion& end, double z, double duration,
                              std::vector<double>& out) const {
    constexpr double around = 1;  // [m] about the maps
    const Vec3 low = scene_->lower_left(), high = scene_->upper_right();
    double first = 0, last = duration;
    clip(end.from.x, end.velocity.x, low.x - around, high.x + around, first, last);
    clip(end.from.y, end.velocity.y, low.y - around, high.y + around, first, last);
    if (!(first < last)) return;
    Vec3 p = end.at(first), q = end.at(last);
    p.z = q.z = z;
    const double length = distance(p, q);
    if (!(length > 0)) return;
    for (const Crossing& c : scene_->crossings(p, q))
        for (const double at : {c.entry, c.exit}) {
            const double t = first + (last - first) * (at / length);
            if (t > 0 && t < duration) out.push_back(t);
        }
}

void WallPassages::pass_levels(const Sight& sight, std::vector<double>& out) const {
    Interval z;
    for (const Vec3 p : sight.ends) z.add(p.z);
    if (levels_.empty() || levels_.front() > z.high || levels_.back() < z.low) return;
    if (!(z.low < z.high)) return;
    for (const double height : levels_)
        for (const StraightMotion& end : {sight.a, sight.b}) {
            const double t = (height - end.from.z) / end.velocity.z;
            if (sight.holds(t)) out.push_back(t);
        }
    const Box swept = box_of(sight.ends);
    for (const End& end : ends_) {
        if (!(end.corners[0].z >= z.low && end.corners[0].z <= z.high)) continue;
        if (!box_of(end.corners).meets(swept)) continue;
        for (std::size_t i = 0; i < 4; ++i)
            sight.visit_edge(end.corners[i], end.corners[(i + 1) % 4],
                             [&](double t) { out.push_back(t); });
    }
}

}  // namespace rovernet
