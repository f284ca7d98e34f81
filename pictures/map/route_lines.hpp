// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/reports/route_way.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Route in a picture: an arrow for each hop, with the age of the route beside the arrow. A hop
/// whose link is down is dashed. The robot at which the route breaks off has a cross.
class RouteLines {
  public:
    explicit RouteLines(RouteWay way) : way_(std::move(way)) {}

    /// Sentence about the hops of the route, see route_way_text().
    std::string text(const Network& network) const { return route_way_text(network, way_); }
    /// Makes labels avoid the arrows. Leaves room for a ring around the robot at which the route
    /// breaks off.
    void keep_off(LabelPlaces& places, RobotMarks& robots) const;
    /// Places the ages of the routes. Called after the names of the robots are placed.
    void place_ages(LabelPlaces& places, const RobotMarks& robots);
    void draw(Svg& svg, const RobotMarks& robots) const;
    void append_to(Legend& legend) const;

  private:
    struct Age {
        std::string text;
        PicturePoint at;  // middle of the baseline
        bool is_up;       // whether the link of the hop is up
    };

    RouteWay way_;
    std::vector<Age> ages_ = {};
};

}  // namespace rovernet
