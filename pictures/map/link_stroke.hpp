// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>
#include <string>

namespace rovernet {

/// Style of a line that shows a link of some grade.
struct LinkStroke {
    std::size_t grade;    ///< index in link_grades
    bool dashed = false;  ///< dashed line, for a one-way link
    bool seam = false;    ///< white line that is wider, to be drawn below the line on a heat map
    double width = 1;     ///< width of the line relative to the grade's width [-]
};

/// Draws a path as a line in the style `stroke`.
/// @param data  data of the SVG path
void draw_link_stroke(Svg& svg, const std::string& data, const LinkStroke& stroke);
/// Entry of a legend: a line in the style `stroke`; a dashed line has an arrow head.
LegendItem link_sample(std::string text, const LinkStroke& stroke);

/// Draws a path as a hollow line, which stands for a missing link. It differs from the lines of all
/// grades in black and white, too.
void draw_gap_stroke(Svg& svg, const std::string& data);
/// Entry of a legend: a hollow line.
LegendItem gap_sample(std::string text);

}  // namespace rovernet
