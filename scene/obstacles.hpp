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
    /// @param index  spatial index of the cells that robots must not enter; not null
    Obstacles(const MapFrame& frame, std::shared_ptr<const WallIndex> index)
        : frame_(frame), index_(std::move(index)) {}

    /// Distance from p to the nearest obstacle [m]: 0 if p is in an obstacle or touches it,
    /// infinity without obstacles.
    double clearance(Vec3 p) const;
    /// Whether a disc of the given radius [m] can move straight from a to b without entering an
    /// obstacle; touching is allowed.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Appends to `out` the contacts with obstacles of a disc of the given radius [m] at p. The
    /// position p must be outside of all obstacles.
    void add_contacts(Vec3 p, Meters radius, std::vector<Contact>& out) const;

  private:
    MapFrame frame_;
    std::shared_ptr<const WallIndex> index_;
};

}  // namespace rovernet
