// SPDX-License-Identifier: MIT
#include "routing/suppression/disc_cover.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace rovernet {
namespace {

using std::numbers::pi;

/// Point of the plane, in radii of the discs.
struct Point {
    double x, y;
    friend bool operator==(const Point&, const Point&) = default;
};

/// Union of arcs of a circle, as angles from -pi to pi.
class Arcs {
  public:
    void clear() { arcs_.clear(); }
    /// Adds the arc of `half` to both sides of `middle`, |middle| <= 2 pi.
    void add(double middle, double half) {
        double from = middle - half, to = middle + half;
        if (from < -pi) from += 2 * pi, to += 2 * pi;
        if (from > pi) from -= 2 * pi, to -= 2 * pi;
        arcs_.push_back({from, std::min(to, pi)});
        if (to > pi) arcs_.push_back({-pi, to - 2 * pi});
    }
    /// Calls visit(from, to) for each part of the circle that lies on no arc.
    template <class Visit>
    void for_each_gap(Visit visit) {
        std::sort(arcs_.begin(), arcs_.end(),
                  [](const Arc& a, const Arc& b) { return a.from < b.from; });
        double end = -pi;
        for (const Arc& arc : arcs_) {
            if (arc.from > end) visit(end, arc.from);
            end = std::max(end, arc.to);
        }
        if (end < pi) visit(end, pi);
    }

  private:
    struct Arc {
        double from, to;
    };
    std::vector<Arc> arcs_;
};

/// Twice the share of an arc of the circle around `centre` in Green's integral.
double green(Point centre, double from, double to) {
    const auto a = math::sincos(from), b = math::sincos(to);
    return to - from + centre.x * (b.sin - a.sin) - centre.y * (b.cos - a.cos);
}

}  // namespace

double uncovered_share(std::span<const Vec3> centres, double radius) {
    std::vector<Point> discs{{0, 0}};
    for (const Vec3& each : centres) {
        const Point disc{each.x / radius, each.y / radius};
        if (disc == discs[0]) return 0;
        const bool is_known = std::find(discs.begin(), discs.end(), disc) != discs.end();
        if (!is_known && disc.x * disc.x + disc.y * disc.y < 4) discs.push_back(disc);
    }
    Arcs elsewhere;  // arcs of a circle that are no border of the uncovered part
    double twice_area = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        elsewhere.clear();
        for (std::size_t j = 0; j < discs.size(); ++j) {
            const double x = discs[j].x - discs[i].x, y = discs[j].y - discs[i].y;
            const double d2 = x * x + y * y;
            if (j == i || d2 >= 4) continue;
            // The arc of circle i in disc j; in the first disc it is the arc outside that counts.
            const double half = math::atan2(std::sqrt(4 - d2), std::sqrt(d2));
            const double middle = math::atan2(y, x);
            j == 0 ? elsewhere.add(middle + pi, pi - half) : elsewhere.add(middle, half);
        }
        // The uncovered part lies to the left of the first circle, to the right of the others.
        elsewhere.for_each_gap([&](double from, double to) {
            twice_area += (i == 0 ? 1 : -1) * green(discs[i], from, to);
        });
    }
    return std::clamp(twice_area / (2 * pi), 0.0, 1.0);
}

}  // namespace rovernet
