// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rovernet {

/// Entry of a legend: a symbol and its meaning.
struct LegendItem {
    std::string text;
    double width = 24;  ///< width of the symbol [px]
    /// Function that draws the symbol; its argument is the middle of the symbol's left edge. None:
    /// the text is a bold title of the entries after it.
    std::function<void(Svg&, PicturePoint)> draw = nullptr;
};

/// Legend of a picture: entries in rows, from left to right.
class Legend {
  public:
    void add(LegendItem item) { items_.push_back(std::move(item)); }
    /// Height of the legend [px] if its width is `width` [px].
    double height(double width) const;
    /// Draws the legend. @param corner  upper left corner of the legend
    void draw(Svg& svg, PicturePoint corner, double width) const;

  private:
    /// Left end of each entry, relative to the legend's upper left corner.
    std::vector<PicturePoint> places(double width) const;

    std::vector<LegendItem> items_;
};

/// Scale bar of a round length: about a sixth of the plot's width, at least 2 px.
LegendItem scale_bar(const Plot& plot);

/// Lines of text: `parts` joined by " · ", with line breaks between parts so that lines fit into
/// `width` [px]. A part that is too long alone is broken between words.
std::vector<std::string> wrapped(const std::vector<std::string>& parts, double width, double size);

}  // namespace rovernet
