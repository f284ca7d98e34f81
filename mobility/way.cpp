// SPDX-License-Identifier: MIT
#include "mobility/way.hpp"

#include "mobility/planners.hpp"
#include "sim/fields.hpp"

#include <algorithm>

namespace rovernet {

std::optional<Way> Way::plan(Mover& mover, Vec3 to) {
    for (const double x : {to.x, to.y, to.z}) {
        if (!any.contains(x)) throw_out_of_range("waypoints", "a place", any.text, x);
    }
    auto corners = mover.planners.shortest_path(mover.position, to, mover.radius);
    if (!corners) return std::nullopt;
    Way way;
    std::reverse(corners->begin(), corners->end());
    if (!corners->empty()) {
        way.left_ = std::make_unique<Left>(Left{std::move(*corners)});
    }
    return way;
}

std::optional<Leg> Way::next_leg(const Mover& mover, MetersPerSecond speed) {
    while (left_) {
        left_->speed = speed;
        const Vec3 corner = left_->corners.back();
        left_->corners.pop_back();
        if (left_->corners.empty()) left_.reset();
        if (corner != mover.position) return straight_leg(mover, corner, speed);
    }
    return std::nullopt;
}

double Way::length_left(const Mover& mover) const {
    double length = 0;
    Vec3 at = mover.position;
    if (!left_) return 0;
    const auto& corners = left_->corners;
    for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner) {
        length += distance(at, *corner);
        at = *corner;
    }
    return length;
}

}  // namespace rovernet
