// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <vector>

namespace rovernet {

/// Axes in metres, left of and below the plot area, with ticks at round numbers.
class MapAxes {
  public:
    explicit MapAxes(const Plot& plot);

    double left() const;                 ///< width of the axis left of the plot [px]
    static constexpr double below = 40;  ///< height of the axis below the plot [px]
    /// @param plot  must equal the constructor's plot in size and in the visible part of the world
    void draw(Svg& svg, const Plot& plot) const;

  private:
    std::vector<double> x_, y_;  // ticks [m]
};

}  // namespace rovernet
