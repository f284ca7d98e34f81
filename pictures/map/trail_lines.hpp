// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/link_grades.hpp"
#include "pictures/map/margin_survey.hpp"
#include "pictures/map/robot_marks.hpp"
#include "pictures/map/trail.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace rovernet {

/// Past paths of robots in a picture, with a ring at the start and dots at equal time intervals.
/// The lines are thin and have the robots' colours, or show the grades of the robots' links
/// (link_grades).
class TrailLines {
  public:
    /// Collects the parts of paths on one storey, and on the stairs that begin or end on this
    /// storey.
    /// @param trails  trails of the network's robots; trails and network must outlive the lines
    /// @param storey  number of the storey
    /// @param survey  margins of links, for lines that show grades of links; null: lines in the
    ///                robots' colours. Must outlive the lines
    TrailLines(const Trails& trails, const Network& network, Time at, std::size_t storey,
               const MarginSurvey* survey = nullptr);

    void include_in(Extent& extent) const;
    void draw(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_to(Legend& legend) const;

  private:
    struct Trail {
        std::string lines = {}, dots = {}, rings = {};  // path data of the SVG
    };

    bool is_here(Vec3 p) const;
    std::vector<std::vector<Vec3>> ways(NodeId node) const { return ways(node, start_of_run, at_); }
    std::vector<std::vector<Vec3>> ways(NodeId node, Time begin, Time end) const;
    bool has_grades(NodeId node) const { return survey_ && !survey_->is_station(node); }
    /// Path data by grade of the link; the last element is the path without a link.
    std::array<SvgPath, link_grades.size() + 1> graded(const Plot& plot) const;
    void draw_grades(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_grades_to(Legend& legend) const;
    Trail trail(NodeId node, const Plot& plot) const;

    const Trails& trails_;
    const Network& network_;
    std::uint32_t robots_;
    std::size_t storey_;
    Time at_;
    const MarginSurvey* survey_;
    Duration every_{0};  // interval between dots
};

}  // namespace rovernet
