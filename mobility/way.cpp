// SPDX-License-Identifier: MIT
#include "mobility/way.hpp"

#include "sim/fields.hpp"

namespace rovernet {

std::optional<Way> Way::plan(Mover& mover, Vec3 to) {
    for (const double x : {to.x, to.y, to.z}) {
        if (!any.contains(x)) throw_out_of_range("waypoints", "a place", any.text, x);
    }
    auto corners = mover.planners.of_radius(mover.radius).shortest_path(mover.position, to);
    if (!corners) return std::nullopt;
    Way way;
    way.corners_ = std::move(*corners);
    return way;
}

std::optional<Leg> Way::next_leg(const Mover& mover, MetersPerSecond speed) {
    while (done_ < corners_.size()) {
        const Vec3 corner = corners_[done_++];
        if (corner != mover.position) return straight_leg(mover, corner, speed);
    }
    return std::nullopt;
}

double Way::length_left(const Mover& mover) const {
    double length = 0;
    Vec3 at = mover.position;
    for (std::size_t i = done_; i < corners_.size(); ++i) {
        length += distance(at, corners_[i]);
        at = corners_[i];
    }
    return length;
}

}  // namespace rovernet
