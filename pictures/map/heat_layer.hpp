// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/contour.hpp"
#include "pictures/map/coverage.hpp"

#include <optional>
#include <vector>

namespace rovernet {

/// Coverage of one robot's transmitter in a picture: received levels as colours, a colour bar, and
/// contours at the receivers' sensitivity and at the level RadioLabels::range_db [dBm], if it is
/// set.
class HeatLayer {
  public:
    /// Computes the coverage of the plot area.
    /// @param cells  approximate number of cells of the heat map
    HeatLayer(const Transmitter& transmitter, const Plot& plot, int cells);

    void draw_levels(Svg& svg, const Plot& plot) const;
    void draw_contours(Svg& svg, const Plot& plot) const;
    /// Draws the colour bar, bar_width wide. @param corner  upper left corner of the colour bar
    void draw_bar(Svg& svg, PicturePoint corner, double height) const;
    void append_to(Legend& legend) const;
    /// Whether the propagation model gives levels; the model disc gives only a range.
    bool has_levels() const { return !range_; }

    static constexpr double bar_width = 62;  ///< width of the colour bar with its numbers [px]

  private:
    struct Line {
        Dbm level;
        const char* meaning;
        bool dashed;
        std::vector<ContourLine> contours = {};
    };

    CoverageMap map_;
    std::optional<Meters> range_;
    double low_ = 0, high_ = 1;  // ends of the colour scale [dBm]
    std::vector<Line> lines_;
};

}  // namespace rovernet
