// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Kind of a chart, which decides how its points are drawn.
enum class ChartKind {
    /// A line for each series of points, in order of x, with a gap where y is missing.
    lines,
    /// Bars from 0 at categories, grouped by series. Dots replace bars if all bars end within the
    /// upper fifth of the longest bar (bars would hide the differences), or if the axis is
    /// logarithmic (bars cannot begin at 0).
    bars,
    /// A mark for each point, with the point's label.
    scatter,
    /// Cumulative distribution: the share of a series' points at or below x, as steps; y is
    /// ignored.
    cdf,
    /// A row of cells for each series, the first series at the bottom; y is the value of the cell
    /// at x.
    heat_map,
};

/// Point of a chart. Values that are not finite, beyond 1e100, or not above 0 on a logarithmic axis
/// are omitted, and the chart states their number.
struct ChartPoint {
    double x = 0;               ///< position of the point on a numeric x axis
    std::string category = {};  ///< categorical x; if given, the numeric x is ignored
    double y = 0;
    std::optional<double> low = {}, high = {};      ///< ends of the error bar around y
    std::optional<double> x_low = {}, x_high = {};  ///< ends of the error bar around x (scatter)
    std::string label = {};                         ///< text beside the point, in a scatter chart
    std::uint64_t n = 0;                            ///< number of observations; 0: unknown
};

/// Series of points with one style and one entry in the legend.
struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points = {};
    /// Index of another series to which this series belongs, such as measurements beside a computed
    /// line. This series then has the colour and the mark of that series; its marks are hollow, and
    /// no line joins them.
    std::optional<std::size_t> beside = {};
};

/// Line behind the marks of a scatter chart, such as the Pareto front of the best points. Only
/// chart_svg() draws it.
struct ChartGuide {
    std::vector<ChartPoint> points = {};
    bool dashed = false;
};

/// Natural bounds of the numbers of a chart's axis, such as 0 and 1 of a ratio. Axis and intervals
/// are clipped to these bounds. An axis with two bounds shows the whole range between the bounds,
/// unless the numbers use less than a fifth of this range.
struct ChartLimits {
    std::optional<double> low = {}, high = {};
};

/// Chart as plain data. Labels include units; any text may be empty.
struct Chart {
    ChartKind kind = ChartKind::lines;
    std::string title = {}, x_label = {}, y_label = {};
    std::string value_label = {};   ///< quantity that a heat map shows by colours, with unit
    std::string legend_title = {};  ///< quantity that distinguishes the series, such as "ttl"
    std::string note = {};  ///< text below the chart: meaning of intervals, source of numbers
    bool log_x = false, log_y = false;     ///< true: logarithmic axis (numeric axes only)
    ChartLimits x_limits = {};             ///< bounds of a numeric x
    ChartLimits y_limits = {};             ///< bounds of y, or of the values of a heat map
    std::vector<ChartSeries> series = {};  ///< series of points; names are unique
    std::vector<ChartGuide> guides = {};   ///< lines behind the marks of a scatter chart
    /// Upper end, in y, of a grey band at the lower edge of a scatter, and its label. Only
    /// chart_svg() draws it.
    std::optional<double> band = {};
    std::string band_label = {};
};

/// Arrangement of the charts in a picture.
struct ChartLayout {
    std::string title = {};
    double width = 640;   ///< [px] width of a chart with all its texts, >= 200
    double height = 320;  ///< [px] height of the area between the axes, >= 80
    int columns = 2;      ///< largest number of charts side by side, >= 1
    double scale = 1;     ///< pixels of the document for each pixel of this layout, > 0

    /// Margin around the picture [px]; the gap between charts is twice as wide.
    static constexpr double margin = 16;
    /// Width of a picture with `charts` charts side by side [px].
    double picture_width(int charts = 1) const { return charts * (width + 2 * margin); }
};

/// Draws charts as one SVG document, row by row. The bytes are the same on every machine. A chart
/// without values shows "no results".
/// @throws std::invalid_argument if the layout is out of range
std::string chart_svg(std::span<const Chart> panels, const ChartLayout& layout = {});

/// Chart as a gnuplot script (5.2 or later) with its data, for users who want another style. The
/// script writes an SVG to standard output. Texts of the chart are escaped, so that gnuplot never
/// executes a text as a command.
std::string chart_gnuplot(const Chart& chart);

}  // namespace rovernet
