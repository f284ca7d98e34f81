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
    /// The parts of ways on one storey; of stairs all that begin or end there.
    /// @param trails  of the network's robots; both outlive the lines
    /// @param storey  its number
    TrailLines(const Trails& trails, const Network& network, Time at, std::size_t storey);

    void include_in(Extent& extent) const;
    void draw(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_to(Legend& legend) const;

  private:
    struct Trail {
        std::string lines = {}, dots = {}, rings = {};  // data of paths
    };

    bool is_here(Vec3 p) const;
    std::vector<std::vector<Vec3>> ways(NodeId node) const;
    Trail trail(NodeId node, const Plot& plot) const;

    const Trails& trails_;
    const Network& network_;
    std::uint32_t robots_;
    std::size_t storey_;
    Time at_;
    Duration every_{0};  // between dots
};

}  // namespace rovernet
