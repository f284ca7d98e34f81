// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/contour.hpp"
#include "pictures/map/coverage.hpp"

#include <span>
#include <vector>

namespace rovernet {

/// Coverage of robots' transmitters in a picture: at each place the level of the best transmitter
/// as a colour, a colour bar, and contours at the receivers' sensitivity and at the level
/// RadioLabels::range_db [dBm], if it is set.
class HeatLayer {
  public:
    /// Computes the coverage of the plot area.
    /// @param transmitters  at least one, all for the same receivers; either all or none have the
    ///                      model disc
    /// @param cells         approximate number of cells of the heat map
    HeatLayer(std::span<const Transmitter> transmitters, const Plot& plot, int cells);

    void draw_levels(Svg& svg, const Plot& plot) const;
    void draw_contours(Svg& svg, const Plot& plot) const;
    /// Draws the colour bar, bar_width wide. @param corner  upper left corner of the colour bar
    void draw_bar(Svg& svg, PicturePoint corner, double height) const;
    void append_to(Legend& legend) const;
    /// Whether the propagation model gives levels; the model disc gives only a range.
    bool has_levels() const { return ranges_.empty(); }

    static constexpr double bar_width = 62;  ///< width of the colour bar with its numbers [px]

  private:
    struct Line {
        Dbm level;
        const char* meaning;
        bool dashed;
        std::vector<ContourLine> contours = {};
    };

    CoverageMap map_;
    std::vector<double> ranges_;  // ranges of the model disc [m], ascending; empty: levels
    double low_ = 0, high_ = 1;   // ends of the colour scale [dBm]
    std::vector<Line> lines_;
};

}  // namespace rovernet
