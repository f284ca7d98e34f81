// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

namespace rovernet {

/// Appends the head of an arrow from `from` to `to`, which ends `back` [px] before `to`; nothing if
/// there is no room.
/// @param width  width of the arrow's line [px]
void append_arrow_head(SvgPath& heads, PicturePoint from, PicturePoint to, double back,
                       double width);

}  // namespace rovernet
