// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <vector>

namespace rovernet {

/// Axes in metres, left of the part of a picture that shows the world and below it, with ticks at
/// round places.
class MapAxes {
  public:
    explicit MapAxes(const Plot& plot);

    double left() const;                 ///< [px] of room that they need left of the plot
    static constexpr double below = 40;  ///< [px] below it
    /// @param plot  of the same size and part of the world as at first
    void draw(Svg& svg, const Plot& plot) const;

  private:
    std::vector<double> x_, y_;  // ticks [m]
};

}  // namespace rovernet
