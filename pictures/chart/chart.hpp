// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Kind of a chart: what its points are drawn as.
enum class ChartKind {
    /// A line per series through its points in the order of x, broken where a y is missing.
    lines,
    /// Bars from 0 at words, grouped by series. Dots take their place where bars would hide the
    /// differences (all ends within the upper fifth of the longest bar) or cannot begin at 0 (a
    /// logarithmic axis): a bar is read by its length, a dot by its place.
    bars,
    /// A mark per point, with its label.
    scatter,
    /// The share of a series' points at or below x, as steps; y is not looked at.
    cdf,
    /// A row of cells per series, the first at the bottom and named as the series; y is the value
    /// of the cell at x.
    heat_map,
};

/// A point of a chart. What is not finite, beyond 1e100, or not above 0 on a logarithmic axis is
/// left out, and the chart says how many values that are.
struct ChartPoint {
    double x = 0;               ///< place if x is a number
    std::string category = {};  ///< place if x is a word; then the number is not looked at
    double y = 0;
    std::optional<double> low = {}, high = {};      ///< ends of the interval around y
    std::optional<double> x_low = {}, x_high = {};  ///< ends of the interval around x, in a scatter
    std::string label = {};                         ///< written beside it, in a scatter
    std::uint64_t n = 0;  ///< observations behind it; 0 if that is not known
};

/// Points that belong together.
struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points = {};
};

/// Line of a scatter behind its marks, through places of the chart, such as along the points that
/// no other beats. Only chart_svg() draws it.
struct ChartGuide {
    std::vector<ChartPoint> points = {};
    bool dashed = false;
};

/// Bounds that the numbers of an axis cannot pass, such as 0 and 1 of a ratio. Neither the axis nor
/// an interval goes beyond them; of an axis with both, the whole is shown unless the numbers use
/// less than a fifth of it.
struct ChartLimits {
    std::optional<double> low = {}, high = {};
};

/// A chart as plain data. Labels carry their units; any text may be empty.
struct Chart {
    ChartKind kind = ChartKind::lines;
    std::string title = {}, x_label = {}, y_label = {};
    std::string value_label = {};   ///< label of the colours of a heat map
    std::string legend_title = {};  ///< what tells the series apart, such as "ttl"
    std::string note = {};  ///< below it: what the intervals are, where the numbers are from
    bool log_x = false, log_y = false;     ///< logarithmic axes, of numbers only
    ChartLimits x_limits = {};             ///< limits of x, if it is a number
    ChartLimits y_limits = {};             ///< limits of y, or of the colours of a heat map
    std::vector<ChartSeries> series = {};  ///< series, whose names differ
    std::vector<ChartGuide> guides = {};   ///< lines of a scatter
    /// Upper end of a grey band that a scatter has at its lower edge, in y, and what it says. Only
    /// chart_svg() draws it.
    std::optional<double> band = {};
    std::string band_label = {};
};

/// Arrangement of the charts of a picture.
struct ChartLayout {
    std::string title = {};
    double width = 640;   ///< [px] of a chart with all its texts, 200 at least
    double height = 320;  ///< [px] of the part between its axes, 80 at least
    int columns = 2;      ///< charts side by side at most, 1 at least
    double scale = 1;     ///< pixels of the document to one of these pixels, > 0

    static constexpr double margin = 16;  ///< [px] around the picture, and twice between charts
    /// Width of a picture with so many charts side by side [px].
    double picture_width(int charts = 1) const { return charts * (width + 2 * margin); }
};

/// Draws charts as one Scalable Vector Graphics document, row by row. The same bytes on every
/// machine. A chart without a value says "no results".
/// @throws std::invalid_argument for a layout out of its range
std::string chart_svg(std::span<const Chart> panels, const ChartLayout& layout = {});

/// The chart as a script of gnuplot (5.2 or later) with its numbers inside, to restyle it; it
/// writes an SVG to its standard output. No text of the chart is run as a command.
std::string chart_gnuplot(const Chart& chart);

/// The chart as a specification of Vega-Lite 5 with its numbers inside, as JSON.
std::string chart_vega_lite(const Chart& chart);

}  // namespace rovernet
