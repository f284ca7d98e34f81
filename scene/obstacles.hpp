// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/wall_index.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace rovernet {

/// What a disc touches, seen from its middle: it cannot set out in a direction that is nearer to
/// `towards` than `half_angle`.
struct Contact {
    double towards;     ///< direction of the nearest point [rad], counter-clockwise from the x axis
    double half_angle;  ///< [rad]: a quarter turn at a face, less at a corner that is not reached
};

/// Gap within which a disc touches [m]: robots stop a micrometre before an obstacle.
inline constexpr double contact_gap = 2e-6;

/// Obstacles on one map: where robots must not go.
class Obstacles {
  public:
    /// @param index  not null
    Obstacles(const MapFrame& frame, std::shared_ptr<const WallIndex> index)
        : frame_(frame), index_(std::move(index)) {}

    /// Distance to the nearest obstacle [m]: 0 inside or touching, infinity if there is none.
    double clearance(Vec3 p) const;
    /// A disc of that radius [m] can move straight from a to b; touching is allowed.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Adds what a disc of that radius at p touches, outside of the obstacles.
    void add_contacts(Vec3 p, Meters radius, std::vector<Contact>& out) const;

  private:
    MapFrame frame_;
    std::shared_ptr<const WallIndex> index_;
};

}  // namespace rovernet
