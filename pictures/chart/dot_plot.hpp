// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// A dot of a row: its place on the main scale and on the one beside it.
struct Dot {
    std::size_t series = 0;
    double value = 0;
    std::optional<double> low = {}, high = {};  ///< ends of the interval around the value
    double beside = 0;                          ///< > 0
};

/// Things by name, one in each row.
struct DotRow {
    std::string name;
    bool bold = false;
    std::vector<Dot> dots = {};  ///< one or more; a line joins each to the next
};

/// A dot plot: names in rows, dots on a scale, and to the right the same dots on a second,
/// logarithmic scale. Every name has room, however close the dots are.
/// Source: W. S. Cleveland, The Elements of Graphing Data, 1985, chapter 3.
struct DotPlot {
    std::string title = {};
    std::string value_label = {}, beside_label = {};  ///< what the scales show, with units
    bool log = false;  ///< main scale; values <= `least` then stand at its left end
    double least = 0;
    std::vector<std::string> series = {};
    std::vector<DotRow> rows = {};  ///< from the top
    /// Right end of a grey band that begins at the left end of the main scale, and what it says.
    std::optional<double> band = {};
    std::string band_label = {};
    std::string note = {};
};

/// Draws dot plots side by side, `columns` in a row of the picture, as one Scalable Vector Graphics
/// document. The same bytes on every machine.
/// @param width  [px] of a plot, 300 at least
std::string dot_plot_svg(std::span<const DotPlot> plots, const std::string& title, double width,
                         std::size_t columns);

}  // namespace rovernet
