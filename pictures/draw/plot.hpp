// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Bounding rectangle of shapes in the world [m], parallel to the axes; z is ignored.
class Extent {
  public:
    /// Extends the rectangle so that it includes a disc.
    void include(Vec3 centre, double radius = 0);
    /// Adds a margin [m] on every side of the rectangle.
    void grow(double x, double y);

    bool empty() const { return !low_; }
    Vec3 low() const { return low_.value_or(Vec3{}); }
    Vec3 high() const { return high_; }
    double width() const { return high_.x - low().x; }     ///< width of the rectangle [m]
    double height() const { return high_.y - low().y; }    ///< height of the rectangle [m]
    Vec3 centre() const { return 0.5 * (low() + high_); }  ///< centre of the rectangle [m]

  private:
    std::optional<Vec3> low_;
    Vec3 high_;
};

/// Point of a picture [px]; y points down.
struct PicturePoint {
    double x = 0;
    double y = 0;
};

/// Plot area of a picture that shows the world: maps metres to pixels, with equal scales for x and
/// y.
class Plot {
  public:
    /// Limits of the size of a plot. The plot is the largest one that fits. If the plot would be
    /// smaller than the least size, it shows more of the world than the given extent, which stays
    /// in the middle.
    struct Limits {
        double width = 1000, height = 800;  ///< largest size of the plot [px], > 0
        double least_width = 300,
               least_height = 150;  ///< least size of the plot [px], not above width and height
    };
    Plot() = default;
    Plot(const Extent& extent, PicturePoint corner, const Limits& limits);

    PicturePoint at(Vec3 p) const {
        return {left + (p.x - low.x) * scale, top + (high.y - p.y) * scale};
    }
    double right() const { return left + width; }
    double bottom() const { return top + height; }

    double left = 0, top = 0, width = 1, height = 1;  ///< place and size in the picture [px]
    double scale = 1;                                 ///< pixels for each metre of the world [px/m]
    Vec3 low{},
        high{1, 1};  ///< lower left and upper right corner of the visible part of the world [m]
};

/// Largest round number (... 0.2, 0.5, 1, 2, 5, 10, 20, 50 ...) that is <= `most` > 0.
double round_number(double most);

/// Positions of axis ticks from `low` to `high`, at multiples of a round step. The number of ticks
/// is at most `most` (>= 2), and nearly as large.
std::vector<double> round_ticks(double low, double high, int most);

/// Length with its unit, for a scale bar: "20 cm", "5 m", "2 km".
std::string length_text(double metres);

}  // namespace rovernet
