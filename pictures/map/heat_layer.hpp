// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/contour.hpp"
#include "pictures/map/coverage.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The coverage of one robot in a picture: levels as colours, with a bar that tells them, and the
/// contours at its sensitivity and at its radio's range_db.
class HeatLayer {
  public:
    /// Works out what covers the plot. @param cells  of the heat map, about
    HeatLayer(const Transmitter& transmitter, const Plot& plot, int cells);

    void draw_levels(Svg& svg, const Plot& plot) const;
    void draw_contours(Svg& svg, const Plot& plot) const;
    /// The colour bar, its upper left corner there; bar_width wide.
    void draw_bar(Svg& svg, PicturePoint corner, double height) const;
    void append_to(Legend& legend) const;

    static constexpr double bar_width = 62;  ///< [px] with its numbers

  private:
    struct Line {
        Dbm level;
        const char* meaning;
        bool dashed;
        std::vector<ContourLine> contours = {};
    };

    CoverageMap map_;
    double low_ = 0, high_ = 1;  // [dBm] where the colours end
    std::vector<Line> lines_;
};

}  // namespace rovernet
