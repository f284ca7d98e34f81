// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/draw/color.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

/// Text size of ticks, values, legends and notes [px].
inline constexpr double chart_text_size = 11;
inline constexpr double text_drop = 4;  ///< [px] from the middle of a text line to its baseline
inline constexpr double chart_label_size = 12;   ///< [px] text size of axis labels
inline constexpr double chart_title_size = 14;   ///< [px] text size of chart titles
inline constexpr double chart_line_height = 15;  ///< [px] line height of notes
inline constexpr const char* chart_ink = "#333333";
inline constexpr const char* chart_grid = "#e4e4e4";
/// Colour of the band that marks values beyond a limit.
inline constexpr const char* chart_band_color = "#e3e3e3";
inline constexpr Color chart_note_color{0x55, 0x55, 0x55};
inline constexpr int most_ticks = 8;  ///< largest number of ticks of an axis in gnuplot scripts

/// Mark of a series: its point type in gnuplot and its corners.
struct ChartMarker {
    int gnuplot = 0;
    std::span<const PicturePoint> corners = {};  // corners of a mark of radius 1

    /// Appends the mark to a path. @param radius  radius of the mark [px]
    void append_to(SvgPath& path, PicturePoint centre, double radius) const;
};

/// Style of a series. Colour, dashes and mark each suffice to distinguish the first few series, so
/// that charts are readable for colour-blind people and in grey.
struct ChartStyle {
    Color color;
    std::vector<double> dashes;  ///< lengths [px] of dashes and gaps, in turn; empty: a solid line
    ChartMarker marker;
    bool hollow = false;  ///< true: marks are white inside, and no line joins them

    /// Dashes in the notation of SVG (stroke-dasharray).
    std::string dash_text() const;
};

/// Style of series number `series`, from 0; styles repeat after a few dozen series.
ChartStyle chart_style(std::size_t series);
/// Style of a series of a chart: chart_style() of the series' number. If ChartSeries::beside is
/// given: chart_style() of the number `beside`, with hollow marks.
ChartStyle style_in(const Chart& chart, std::size_t series);

}  // namespace rovernet
