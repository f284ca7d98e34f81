// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// An upright rectangle of the world [m] that grows around what is put into it; z is ignored.
class Extent {
  public:
    /// Makes room for a disc.
    void include(Vec3 centre, double radius = 0);
    /// Adds a margin [m] on every side.
    void grow(double x, double y);

    bool empty() const { return !low_; }
    Vec3 low() const { return low_.value_or(Vec3{}); }
    Vec3 high() const { return high_; }
    double width() const { return high_.x - low().x; }     ///< [m]
    double height() const { return high_.y - low().y; }    ///< [m]
    Vec3 centre() const { return 0.5 * (low() + high_); }  ///< [m]

  private:
    std::optional<Vec3> low_;
    Vec3 high_;
};

/// A point of a picture [px]; y points down.
struct PicturePoint {
    double x = 0;
    double y = 0;
};

/// The part of a picture that shows the world: metres to pixels, the same scale both ways.
class Plot {
  public:
    /// The largest plot of `extent` in a box of so many pixels; never empty, and never narrower or
    /// lower than the least sizes: then it shows more than the extent, which stays in its middle.
    struct Limits {
        double width = 1000, height = 800;             ///< [px] > 0, at most
        double least_width = 300, least_height = 150;  ///< [px], not above the limits
    };
    Plot() = default;
    Plot(const Extent& extent, PicturePoint corner, const Limits& limits);

    PicturePoint at(Vec3 p) const {
        return {left + (p.x - low.x) * scale, top + (high.y - p.y) * scale};
    }
    double right() const { return left + width; }
    double bottom() const { return top + height; }

    double left = 0, top = 0, width = 1, height = 1;  ///< [px]
    double scale = 1;                                 ///< [px/m]
    Vec3 low{}, high{1, 1};                           ///< corners of what it shows [m]
};

/// The largest of 1, 2, 5, 10, 20, 50 ... (and 0.5, 0.2 ...) that is at most `most` > 0.
double round_number(double most);

/// Multiples of a round step from `low` to `high`, about `most` >= 2 of them and no more.
std::vector<double> round_ticks(double low, double high, int most);

/// A length with its unit as on a scale bar: "20 cm", "5 m", "2 km".
std::string length_text(double metres);

}  // namespace rovernet
