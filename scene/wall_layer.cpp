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

/// The part of a segment of that length that runs below `height`; empty if from >= to.
Part below(double height, Vec3 a, Vec3 b, double length) {
    const bool low_a = a.z < height, low_b = b.z < height;
    if (low_a && low_b) return {0, length};
    if (!low_a && !low_b) return {0, 0};
    const double top = (height - a.z) / (b.z - a.z) * length;
    return low_a ? Part{0, top} : Part{top, length};
}

}  // namespace

void WallLayer::append_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    const double length = distance(a, b);
    const Part low = below(height, a, b, length);
    if (!(low.from < low.to)) return;
    std::vector<Crossing> all;
    crossings(frame.to_cells(a), frame.to_cells(b), length, all);
    for (Crossing c : all) {
        if (c.entry < low.from || c.exit > low.to) {
            c.entry = std::max(c.entry, low.from);
            c.exit = std::min(c.exit, low.to);
            c.length = c.exit - c.entry;
        }
        if (c.length > 0) out.push_back(c);
    }
}

}  // namespace rovernet
