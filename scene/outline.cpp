// SPDX-License-Identifier: MIT
#include "scene/outline.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

constexpr std::array<int, 4> step_u{1, 0, -1, 0}, step_v{0, 1, 0, -1};  // right, up, left, down
// Cells ahead of a grid point, on both sides of the path in each direction.
constexpr std::array<int, 4> left_u{0, -1, -1, 0}, left_v{0, 0, -1, -1};
constexpr std::array<int, 4> right_u{0, 0, -1, -1}, right_v{-1, 0, 0, -1};

/// Traces outlines, and marks the horizontal edges to the right that were used.
class Tracer {
  public:
    Tracer(int columns, int rows, const MaterialAt& material)
        : columns_(columns),
          rows_(rows),
          material_(material),
          seen_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows + 1)) {}

    std::vector<Outline> all() {
        std::vector<Outline> found;
        for (int v = 0; v <= rows_; ++v)
            for (int u = 0; u < columns_; ++u)
                if (material_(u, v) >= 0 && material_(u, v - 1) < 0 && !seen_[number(u, v)])
                    found.push_back(from(u, v));
        return found;
    }

  private:
    std::size_t number(int u, int v) const {
        return static_cast<std::size_t>(v) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(u);
    }

    /// Outline that starts to the right from a grid point where it has a corner.
    Outline from(int start_u, int start_v) {
        Outline outline;
        int u = start_u, v = start_v;
        std::size_t direction = 0;
        bool corner = true;
        do {
            if (direction == 0) seen_[number(u, v)] = true;
            const auto material =
                static_cast<std::uint8_t>(material_(u + left_u[direction], v + left_v[direction]));
            if (corner || outline.back().material != material)
                outline.push_back({u, v, u, v, material});
            u += step_u[direction];
            v += step_v[direction];
            outline.back().u1 = u;
            outline.back().v1 = v;
            const std::size_t before = direction;
            if (material_(u + right_u[direction], v + right_v[direction]) >= 0)
                direction = (direction + 3) % 4;
            else if (material_(u + left_u[direction], v + left_v[direction]) < 0)
                direction = (direction + 1) % 4;
            corner = direction != before;
        } while (u != start_u || v != start_v || direction != 0);
        return outline;
    }

    int columns_, rows_;
    const MaterialAt& material_;
    std::vector<bool> seen_;
};

/// Moments for the orthogonal regression of edges, weighted by their length.
struct Moments {
    double length = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // about the first point
    double along_x = 0, along_y = 0;
};

class Straightener {
  public:
    Straightener(const Outline& outline, double cell_width, double cell_height)
        : outline_(outline),
          width_(cell_width),
          height_(cell_height),
          tolerance_(std::max(cell_width, cell_height)) {}

    std::vector<OutlineSide> sides() {
        std::vector<OutlineSide> found;
        const std::size_t edges = outline_.size();
        for (std::size_t i = 0; i < edges;) {
            std::size_t end = i + 1;
            while (end < edges && !parted(end)) ++end;
            stairs(i, end, found);
            i = end;
        }
        while (join(found)) {
        }
        return found;
    }

  private:
    const OutlineEdge& edge(std::size_t i) const { return outline_[i % outline_.size()]; }
    /// Turn before that edge: +1 left, -1 right, 0 where the material changes.
    int turn(std::size_t i) const {
        const OutlineEdge &p = edge(i + outline_.size() - 1), &q = edge(i);
        const int cross = (p.u1 - p.u0) * (q.v1 - q.v0) - (p.v1 - p.v0) * (q.u1 - q.u0);
        return (cross > 0) - (cross < 0);
    }
    bool cap(std::size_t i) const { return turn(i) == turn(i + 1); }
    bool is_long(std::size_t i) const {
        const OutlineEdge& e = edge(i);
        return std::abs(e.u1 - e.u0) + std::abs(e.v1 - e.v0) > 1;
    }
    /// Whether no staircase continues from the previous edge to this one: of two consecutive edges
    /// of a staircase one is one cell long.
    bool parted(std::size_t i) const {
        return edge(i).material != edge(i - 1).material || cap(i - 1) || cap(i) ||
               (is_long(i - 1) && is_long(i));
    }

    /// Divides a staircase into sides, each as long as the tolerance allows.
    void stairs(std::size_t begin, std::size_t end, std::vector<OutlineSide>& out) const {
        while (begin < end) {
            std::size_t fits = 1, step = 1;
            // Doubles the step while it fits, then halves it: few fits for long stairs.
            for (bool growing = true; step > 0;) {
                const bool good =
                    begin + fits + step <= end && side(begin, fits + step).deviation <= tolerance_;
                if (good) fits += step;
                growing = growing && good;
                step = growing ? 2 * step : step / 2;
            }
            out.push_back(side(begin, fits));
            begin += fits;
        }
    }

    /// Joins sides that fit one line, once around the outline: neighbours, and pairs with one side
    /// between them, which is then a step of the staircase.
    bool join(std::vector<OutlineSide>& sides) const {
        bool joined = false;
        for (std::size_t i = 0; i < sides.size();) {
            if (join_at(i, 1, sides) || join_at(i, 2, sides)) {
                joined = true;
                i = i >= 2 ? i - 2 : 0;
            } else {
                ++i;
            }
        }
        return joined;
    }

    bool join_at(std::size_t i, std::size_t further, std::vector<OutlineSide>& sides) const {
        if (sides.size() < further + 2) return false;
        const OutlineSide &a = sides[i], &b = sides[(i + further) % sides.size()];
        constexpr double cosine_of_45_degrees = 0.7071;
        const double cosine = a.direction[0] * b.direction[0] + a.direction[1] * b.direction[1];
        if (cosine < cosine_of_45_degrees) return false;
        const OutlineSide& between = sides[(i + 1) % sides.size()];
        if (further == 2 && (between.count > 1 || is_long(between.first))) return false;
        std::size_t count = 0;
        for (std::size_t k = i; k <= i + further; ++k) count += sides[k % sides.size()].count;
        for (std::size_t k = a.first; k < a.first + count; ++k)
            if (edge(k).material != edge(a.first).material) return false;
        const OutlineSide all = side(a.first, count);
        if (all.deviation > tolerance_) return false;
        sides[i] = all;
        for (std::size_t k = 0; k < further; ++k) {
            const std::size_t gone = i + 1 < sides.size() ? i + 1 : 0;
            sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(gone));
            if (gone == 0) --i;
        }
        return true;
    }

    Moments moments(std::size_t first, std::size_t count) const {
        Moments m;
        const OutlineEdge& start = edge(first);
        for (std::size_t i = first; i < first + count; ++i) {
            const OutlineEdge& e = edge(i);
            const double dx = (e.u1 - e.u0) * width_, dy = (e.v1 - e.v0) * height_;
            const double x = (e.u0 - start.u0) * width_ + dx / 2;
            const double y = (e.v0 - start.v0) * height_ + dy / 2;
            const double l = std::abs(dx) + std::abs(dy);
            m.length += l;
            m.x += l * x;
            m.y += l * y;
            m.xx += l * (x * x + dx * dx / 12);
            m.xy += l * (x * y + dx * dy / 12);
            m.yy += l * (y * y + dy * dy / 12);
            m.along_x += dx;
            m.along_y += dy;
        }
        return m;
    }

    OutlineSide side(std::size_t first, std::size_t count) const {
        const OutlineEdge& start = edge(first);
        const double x0 = start.u0 * width_, y0 = start.v0 * height_;
        if (count == 1) {
            return {first,
                    count,
                    {x0, y0},
                    {static_cast<double>((start.u1 > start.u0) - (start.u1 < start.u0)),
                     static_cast<double>((start.v1 > start.v0) - (start.v1 < start.v0))},
                    0};
        }
        const Moments m = moments(first, count);
        const double x = m.x / m.length, y = m.y / m.length;
        const double difference = (m.xx - m.yy) / m.length - (x * x - y * y);
        const double twice = 2 * (m.xy / m.length - x * y);
        const double root = std::sqrt(difference * difference + twice * twice);
        std::array<double, 2> d = difference >= 0 ? std::array{root + difference, twice}
                                                  : std::array{twice, root - difference};
        const double size = std::sqrt(d[0] * d[0] + d[1] * d[1]);
        const double sign = d[0] * m.along_x + d[1] * m.along_y < 0 ? -1 : 1;
        d = size > 0 ? std::array{sign * d[0] / size, sign * d[1] / size} : std::array{1.0, 0.0};
        OutlineSide found{first, count, {x0 + x, y0 + y}, d, 0};
        found.deviation = deviation(found);
        return found;
    }

    double deviation(const OutlineSide& s) const {
        const auto off = [&](int u, int v) {
            return std::abs((u * width_ - s.point[0]) * s.direction[1] -
                            (v * height_ - s.point[1]) * s.direction[0]);
        };
        double most = 0;
        for (std::size_t i = s.first; i < s.first + s.count; ++i) {
            const OutlineEdge& e = edge(i);
            most = std::max({most, off(e.u0, e.v0), off(e.u1, e.v1)});
        }
        return most;
    }

    const Outline& outline_;
    double width_, height_, tolerance_;
};

}  // namespace

std::vector<Outline> outlines(int columns, int rows, const MaterialAt& material) {
    return Tracer(columns, rows, material).all();
}

std::vector<OutlineSide> straight_sides(const Outline& outline, double cell_width,
                                        double cell_height) {
    return Straightener(outline, cell_width, cell_height).sides();
}

}  // namespace rovernet
