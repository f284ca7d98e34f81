// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rovernet {

/// A sign of a picture and what it means.
struct LegendItem {
    std::string text;
    double width = 24;  ///< [px] of the sign
    /// Draws the sign; the point is the middle of its left edge. None: the text stands alone, bold,
    /// as the title of the items after it.
    std::function<void(Svg&, PicturePoint)> draw = nullptr;
};

/// The signs of a picture in rows, from left to right.
class Legend {
  public:
    void add(LegendItem item) { items_.push_back(std::move(item)); }
    /// Height [px] that it needs when it is `width` [px] wide.
    double height(double width) const;
    /// Draws it with its upper left corner there.
    void draw(Svg& svg, PicturePoint corner, double width) const;

  private:
    /// Left end of each item, from the legend's upper left corner.
    std::vector<PicturePoint> places(double width) const;

    std::vector<LegendItem> items_;
};

/// A bar of a round length: about a sixth of the plot, 2 pixels at least.
LegendItem scale_bar(const Plot& plot);

/// The lines that `parts` make when joined by " · ": broken between parts to stay within `width`
/// [px], a part that is too long for itself between words.
std::vector<std::string> wrapped(const std::vector<std::string>& parts, double width, double size);

}  // namespace rovernet
