// SPDX-License-Identifier: MIT
#include "mobility/way.hpp"

#include "sim/fields.hpp"

#include <algorithm>

namespace rovernet {

std::optional<Way> Way::plan(Mover& mover, Vec3 to) {
    for (const double x : {to.x, to.y, to.z}) {
        if (!any.contains(x)) throw_out_of_range("waypoints", "a place", any.text, x);
    }
    auto corners = mover.planners.of_radius(mover.radius).shortest_path(mover.position, to);
    if (!corners) return std::nullopt;
    Way way;
    std::reverse(corners->begin(), corners->end());
    if (!corners->empty()) {
        way.corners_ = std::make_unique<std::vector<Vec3>>(std::move(*corners));
    }
    return way;
}

std::optional<Leg> Way::next_leg(const Mover& mover, MetersPerSecond speed) {
    while (corners_) {
        const Vec3 corner = corners_->back();
        corners_->pop_back();
        if (corners_->empty()) corners_.reset();
        if (corner != mover.position) return straight_leg(mover, corner, speed);
    }
    return std::nullopt;
}

double Way::length_left(const Mover& mover) const {
    double length = 0;
    Vec3 at = mover.position;
    if (!corners_) return 0;
    for (auto corner = corners_->rbegin(); corner != corners_->rend(); ++corner) {
        length += distance(at, *corner);
        at = *corner;
    }
    return length;
}

}  // namespace rovernet
