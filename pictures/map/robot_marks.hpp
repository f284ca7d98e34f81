// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/color.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Robot in a picture.
struct RobotMark {
    std::string name;
    PicturePoint at;
    double radius = 0;   ///< radius of the robot's circle [px]
    double ring = 0;     ///< width of a ring around the circle [px], kept free of names
    double heading = 0;  ///< heading of the robot [rad], counter-clockwise from the x axis
    Presence presence = Presence::on;
    bool here = true;         ///< whether the robot is on the drawn storey
    bool stands_out = false;  ///< whether the robot's coverage is drawn
    Color rim = {};           ///< colour of the robot's circle

    bool on() const { return presence == Presence::on; }
    /// Whether the robot is drawn. A robot on another storey is not drawn. A robot that is not yet
    /// or no longer present is drawn only if its coverage is drawn.
    bool drawn() const { return here && (on() || presence == Presence::off || stands_out); }
};

/// Robots of a picture: circles to scale (radius at least 5 px), with a tick for the heading, and
/// the name where it has room.
class RobotMarks {
  public:
    /// @param storey        number of the drawn storey
    /// @param standing_out  robots whose coverage is drawn
    /// @param colored       true: each circle has the colour of the robot's trail
    RobotMarks(const Network& network, std::size_t storey, const std::vector<NodeId>& standing_out,
               bool colored, const Plot& plot);

    const RobotMark& operator[](NodeId node) const { return marks_[node.index()]; }
    /// Leaves room for a ring around a robot's circle, out to `width` [px] beyond the circle.
    void add_ring(NodeId node, double width) {
        double& ring = marks_[node.index()].ring;
        ring = std::max(ring, width);
    }
    /// Places the names of the robots. @param places  already contains all other obstacles
    void place_names(LabelPlaces& places);
    void draw(Svg& svg) const;
    /// Appends the robots' symbols to a legend, and the number of robots whose name found no room.
    void append_to(Legend& legend) const;

  private:
    struct Name {
        std::string text;
        PicturePoint at;  // start of the baseline
        TextAnchor anchor;
    };

    double name_size() const;
    void keep_marks_free(LabelPlaces& places) const;

    std::vector<RobotMark> marks_;  // marks by NodeId
    std::vector<Name> names_ = {};
    std::size_t homeless_ = 0;  // number of names without room
};

/// Colour of a robot and of its trail (past path).
inline Color robot_color(NodeId node) { return category_color(node.index()); }

}  // namespace rovernet
