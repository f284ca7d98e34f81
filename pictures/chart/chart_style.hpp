// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/color.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

inline constexpr double chart_text_size = 11;  ///< [px] of ticks, values, legends and notes
inline constexpr double text_drop = 4;  ///< [px] from the middle of such a line to its baseline
inline constexpr double chart_label_size = 12;   ///< [px] of the labels of axes
inline constexpr double chart_title_size = 14;   ///< [px] of the title of a chart
inline constexpr double chart_line_height = 15;  ///< [px] of a line of notes
inline constexpr const char* chart_ink = "#333333";
inline constexpr const char* chart_grid = "#e4e4e4";
inline constexpr const char* chart_band_color = "#e3e3e3";  ///< where a limit has been passed
inline constexpr Color chart_note_color{0x55, 0x55, 0x55};
inline constexpr int most_ticks = 8;  ///< ticks of an axis that another program draws

/// The mark of a series: its name as Vega-Lite says it, its number in gnuplot, its corners.
struct ChartMarker {
    const char* vega = "";
    int gnuplot = 0;
    std::span<const PicturePoint> corners = {};  // corners of a mark of radius 1

    /// Appends the mark to a path. @param radius  [px]
    void append_to(SvgPath& path, PicturePoint centre, double radius) const;
};

/// Style of a series: told apart by colour, by dashes and by its mark, each of which does for the
/// first few series alone, so that neither colour-blind eyes nor grey paper lose one.
struct ChartStyle {
    Color color;
    std::vector<double> dashes;  ///< [px] drawn and left, in turn; none: a full line
    ChartMarker marker;

    /// The dashes as SVG writes them.
    std::string dash_text() const;
};

/// The style of the n-th series; styles come again after a few dozen.
ChartStyle chart_style(std::size_t series);

}  // namespace rovernet
