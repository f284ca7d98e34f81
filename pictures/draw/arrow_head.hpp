// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

namespace rovernet {

/// Appends the head of an arrow from `from` to `to`. The arrow ends `back` [px] before `to`. If the
/// distance is too short for a head, nothing is appended.
/// @param width  width of the arrow's line [px]
void append_arrow_head(SvgPath& heads, PicturePoint from, PicturePoint to, double back,
                       double width);

}  // namespace rovernet
