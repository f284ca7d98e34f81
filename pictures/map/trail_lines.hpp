// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"
#include "pictures/map/trail.hpp"

#include <cstdint>
#include <string>

namespace rovernet {

/// The ways that robots have gone, in a picture: thin lines in the robots' colours from a ring at
/// the start, with dots at equal times.
class TrailLines {
  public:
    /// @param trails  of `robots` nodes; outlives the lines
    TrailLines(const Trails& trails, std::uint32_t robots, Time at);

    void include_in(Extent& extent) const;
    /// @param network  of the robots, whose names it says
    void draw(Svg& svg, const Plot& plot, const Network& network, bool on_colors) const;
    void append_to(Legend& legend) const;

  private:
    struct Trail {
        std::string lines = {}, dots = {}, rings = {};  // data of paths
    };

    Trail trail(NodeId node, const Plot& plot) const;

    const Trails& trails_;
    std::uint32_t robots_;
    Time at_;
    Duration every_{0};  // between dots
};

}  // namespace rovernet
