// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/wall_index.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <memory>
#include <utility>

namespace rovernet {

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

  private:
    MapFrame frame_;
    std::shared_ptr<const WallIndex> index_;
};

}  // namespace rovernet
