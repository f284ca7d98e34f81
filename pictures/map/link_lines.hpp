// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"

#include <vector>

namespace rovernet {

/// Links of a picture as lines; a larger margin of the level above the sensitivity gives a darker
/// and wider line. A one-way link is dashed, with an arrow head at the receiver.
class LinkLines {
  public:
    /// Collects the links that are up at time `at`, between robots on one storey.
    /// @param storey  number of the storey
    /// @throws RunError for more than 5000 robots
    LinkLines(const Network& network, Time at, std::size_t storey);

    void draw(Svg& svg, const RobotMarks& robots, bool on_colors) const;
    /// Keeps labels off the links' lines, if lines are few enough to leave room.
    void keep_off(LabelPlaces& places, const RobotMarks& robots) const;
    void append_to(Legend& legend) const;

  private:
    struct Line {
        NodeId from, to;
        double margin = 0;  // level above sensitivity [dB]; two-way link: the smaller one
        bool both_ways = false;
    };

    std::vector<Line> lines_;
    bool has_margins_ = true;           // false for the model disc, without levels
    std::size_t to_other_storeys_ = 0;  // number of links to other storeys, which are not drawn
};

}  // namespace rovernet
