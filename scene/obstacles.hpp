// SPDX-License-Identifier: MIT
#pragma once

#include "scene/contact.hpp"
#include "scene/map_frame.hpp"
#include "scene/wall_index.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace rovernet {

/// Obstacles on one map: cells that robots must not enter.
class Obstacles {
  public:
    /// @param index  not null
    Obstacles(const MapFrame& frame, std::shared_ptr<const WallIndex> index)
        : frame_(frame), index_(std::move(index)) {}

    /// Distance to the nearest obstacle [m]: 0 inside or touching, infinity without obstacles.
    double clearance(Vec3 p) const;
    /// Whether a disc of that radius [m] can move straight from a to b; touching is allowed.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Appends the contacts of a disc of that radius at p, which is outside all obstacles.
    void add_contacts(Vec3 p, Meters radius, std::vector<Contact>& out) const;

  private:
    MapFrame frame_;
    std::shared_ptr<const WallIndex> index_;
};

}  // namespace rovernet
