// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"

#include <vector>

namespace rovernet {

/// The links of a picture: the larger the margin, the darker and the wider the line. A line is
/// dashed where only one end can hear the other, with an arrow head at the one that can.
class LinkLines {
  public:
    /// The links that are up at `at`, between robots on one storey.
    /// @param storey  its number
    /// @throws RunError for more than 5000 robots
    LinkLines(const Network& network, Time at, std::size_t storey);

    void draw(Svg& svg, const RobotMarks& robots, bool on_colors) const;
    /// Labels should not lie on the lines, if they are few enough to leave room.
    void keep_off(LabelPlaces& places, const RobotMarks& robots) const;
    void append_to(Legend& legend) const;

  private:
    struct Line {
        NodeId from, to;
        double margin = 0;  // [dB] of a link both ways, the smaller one
        bool both_ways = false;
    };

    std::vector<Line> lines_;
    std::size_t to_other_storeys_ = 0;  // links that are not drawn
};

}  // namespace rovernet
