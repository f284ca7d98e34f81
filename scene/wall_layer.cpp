// SPDX-License-Identifier: MIT
#include "scene/wall_layer.hpp"

#include <algorithm>

namespace rovernet {
namespace {

/// Part of a segment, in lengths from its start [m].
struct Part {
    double from;
    double to;
};

/// Part of a segment of that length between two heights, without the upper one; empty if from >=
/// to.
Part between(double bottom, double top, Vec3 a, Vec3 b, double length) {
    if (a.z == b.z) return {0, a.z >= bottom && a.z < top ? length : 0};
    const auto way_to = [&](double z) { return (z - a.z) / (b.z - a.z) * length; };
    const auto [lower, upper] = std::minmax({way_to(bottom), way_to(top)});
    return {std::max(lower, 0.0), std::min(upper, length)};
}

}  // namespace

void WallLayer::append_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    const double length = distance(a, b);
    const Part inside = between(bottom, top, a, b, length);
    if (!(inside.from < inside.to)) return;
    std::vector<Crossing> all;
    crossings(frame.to_cells(a), frame.to_cells(b), length, all);
    for (Crossing c : all) {
        if (c.entry < inside.from || c.exit > inside.to) {
            c.entry = std::max(c.entry, inside.from);
            c.exit = std::min(c.exit, inside.to);
            c.length = c.exit - c.entry;
        }
        if (c.length > 0) out.push_back(c);
    }
}

}  // namespace rovernet
