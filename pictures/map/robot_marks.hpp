// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/color.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

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
    Presence presence = Presence::on;
    bool here = true;         ///< on the storey that is drawn
    bool stands_out = false;  ///< its coverage is drawn
    Color rim = {};           ///< colour of its circle

    bool on() const { return presence == Presence::on; }
    /// Whether a robot is drawn: one on its storey; if it is not in the world, only if its coverage
    /// is drawn.
    bool drawn() const { return here && (on() || presence == Presence::off || stands_out); }
};

/// The robots of a picture: circles to scale, though not below 5 px, with a tick that shows the
/// heading and the name beside, where there is room for it.
class RobotMarks {
  public:
    /// @param storey        number of the storey that is drawn
    /// @param standing_out  robot whose coverage is drawn
    /// @param colored       each has a rim of its own colour, that of its trail
    RobotMarks(const Network& network, std::size_t storey, std::optional<NodeId> standing_out,
               bool colored, const Plot& plot);

    const RobotMark& operator[](NodeId node) const { return marks_[node.index()]; }
    /// Finds room for the names. @param places  knows already what else is in the way
    void place_names(LabelPlaces& places);
    void draw(Svg& svg) const;
    /// Appends the robots' signs to a legend, and how many names found no room.
    void append_to(Legend& legend) const;

  private:
    struct Name {
        std::string text;
        PicturePoint at;  // begin of its baseline
        TextAnchor anchor;
    };

    double name_size() const;
    void keep_marks_free(LabelPlaces& places) const;

    std::vector<RobotMark> marks_;  // marks by node
    std::vector<Name> names_ = {};
    std::size_t homeless_ = 0;  // names without room
};

/// The colour of a robot and its trail.
inline Color robot_color(NodeId node) { return category_color(node.index()); }

}  // namespace rovernet
