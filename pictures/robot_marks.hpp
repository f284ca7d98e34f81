// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/network.hpp"
#include "pictures/label.hpp"
#include "pictures/legend.hpp"
#include "pictures/plot.hpp"
#include "pictures/svg.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A robot in a picture.
struct RobotMark {
    std::string name;
    PicturePoint at;
    double radius = 0;   ///< [px] of its circle
    double heading = 0;  ///< [rad], counter-clockwise from the x axis
    bool on = true;
    bool stands_out = false;  ///< its coverage is drawn
};

/// The robots of a picture: circles to scale, though not below 5 px, with a tick that shows the
/// heading and the name beside, where there is room for it.
class RobotMarks {
  public:
    /// @param radii     [m] by node
    /// @param standing_out  whose coverage is drawn
    RobotMarks(const Network& network, const std::vector<Meters>& radii,
               std::optional<NodeId> standing_out, Time at, const Plot& plot);

    const RobotMark& operator[](NodeId node) const { return marks_[node.index()]; }
    /// @param places  of the names; knows already what else is in the way
    void draw(Svg& svg, LabelPlaces& places) const;
    void append_to(Legend& legend) const;

  private:
    void draw_names(Svg& svg, LabelPlaces& places) const;

    std::vector<RobotMark> marks_;  // by node
};

}  // namespace rovernet
