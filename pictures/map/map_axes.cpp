// SPDX-License-Identifier: MIT
#include "pictures/map/map_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace rovernet {
namespace {

constexpr double text_size = 11;  // [px]
constexpr double tick = 5;        // [px] length
constexpr double gap = 3;         // [px] between a tick and its text
constexpr double label = 18;      // [px] room for an axis' label
constexpr double baseline = 4;    // [px] below a line's middle
constexpr const char* axis_ink = "#333333";

std::string tick_text(double metres) { return fmt::format("{:.6g}", metres + 0.0); }

std::vector<double> ticks(double low, double high, double room, double spacing) {
    return round_ticks(low, high, std::max(2, static_cast<int>(room / spacing)));
}

}  // namespace

MapAxes::MapAxes(const Plot& plot)
    : x_(ticks(plot.low.x, plot.high.x, plot.width, 80)),
      y_(ticks(plot.low.y, plot.high.y, plot.height, 60)) {}

double MapAxes::left() const {
    double widest = 0;
    for (const double y : y_) widest = std::max(widest, text_width(tick_text(y), text_size));
    return label + widest + gap + tick;
}

void MapAxes::draw(Svg& svg, const Plot& plot) const {
    SvgPath path;
    svg.open("g", {{"class", "axes"}});
    for (const double x : x_) {
        const double at = plot.at({x, plot.low.y}).x;
        path.move(at, plot.bottom()).vertical(plot.bottom() + tick);
        svg.text(at, plot.bottom() + tick + gap + text_size - 2, tick_text(x),
                 {.size = text_size, .anchor = TextAnchor::middle});
    }
    for (const double y : y_) {
        const double at = plot.at({plot.low.x, y}).y;
        path.move(plot.left, at).horizontal(plot.left - tick);
        svg.text(plot.left - tick - gap, at + baseline, tick_text(y),
                 {.size = text_size, .anchor = TextAnchor::end});
    }
    svg.add("path", {{"d", path.text()}, {"stroke", axis_ink}, {"stroke-width", 1.0}});
    svg.text((plot.left + plot.right()) / 2, plot.bottom() + below - 4, "x [m]",
             {.size = text_size, .anchor = TextAnchor::middle});
    const double x = plot.left - left() + text_size, y = (plot.top + plot.bottom()) / 2;
    svg.open("g", {{"transform", fmt::format("rotate(-90 {} {})", svg_number(x), svg_number(y))}});
    svg.text(x, y, "y [m]", {.size = text_size, .anchor = TextAnchor::middle});
    svg.close();
    svg.close();
}

}  // namespace rovernet
