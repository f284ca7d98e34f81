// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Dot of a row of a dot plot: its value on the main scale and its value on the second scale.
struct Dot {
    std::size_t series = 0;
    double value = 0;
    std::optional<double> low = {}, high = {};  ///< ends of the interval around the value
    double beside = 0;  ///< value on the second scale (right of the main scale), > 0
};

/// Row of a dot plot, with its name.
struct DotRow {
    std::string name;
    bool bold = false;
    std::vector<Dot> dots = {};  ///< dots of the row, at least one; a line joins successive dots
};

/// Dot plot: a name in each row, dots on a main scale, and on its right the same dots on a second,
/// logarithmic scale. Names never overlap, even if dots are close. Source: W. S. Cleveland, The
/// Elements of Graphing Data, 1985, chapter 3.
struct DotPlot {
    std::string title = {};
    std::string value_label = {}, beside_label = {};  ///< labels of both scales, with units
    bool log = false;  ///< true: logarithmic main scale, with values <= `least` at its left end
    double least = 0;
    std::vector<std::string> series = {};
    std::vector<DotRow> rows = {};  ///< rows of the plot, from the top
    /// Right end of a grey band that begins at the left end of the main scale, and its label.
    std::optional<double> band = {};
    std::string band_label = {};
    std::string whisker_label = {};  ///< meaning of the intervals around the dots
    std::string note = {};
};

/// Draws dot plots, `columns` side by side, as one SVG document. The bytes are the same on every
/// machine.
/// @param width  width of a plot [px], >= 300
std::string dot_plot_svg(std::span<const DotPlot> plots, const std::string& title, double width,
                         std::size_t columns);

}  // namespace rovernet
