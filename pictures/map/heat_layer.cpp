// SPDX-License-Identifier: MIT
#include "pictures/map/heat_layer.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "files/base64.hpp"
#include "pictures/map/coverage_levels.hpp"
#include "scene/images/png.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

constexpr const char* contour_color = "#00501e";
constexpr double contour_width = 1.8;  // [px]
constexpr double contour_seam = 3.2;   // [px] of the white below it

/// The map as a picture, its bottom row last.
Image image_of(const CoverageMap& map, double low, double high) {
    constexpr int colors = 256;
    Image image{map.columns, map.rows, 3, {}};
    image.samples.reserve(map.dbm.size() * 3);
    std::vector<Color> table;
    for (int i = 0; i < colors; ++i) table.push_back(lagoon.at(i / (colors - 1.0)));
    for (int row = map.rows - 1; row >= 0; --row) {
        for (int column = 0; column < map.columns; ++column) {
            const double share = std::clamp((map.at(column, row) - low) / (high - low), 0.0, 1.0);
            const Color c = table[static_cast<std::size_t>(share * (colors - 1) + 0.5)];
            image.samples.insert(image.samples.end(), {c.red, c.green, c.blue});
        }
    }
    return image;
}

/// Line in the picture, without points whose removal is invisible.
std::string path_of(const ContourLine& line, const Plot& plot) {
    constexpr double visible = 0.08;  // [px] from a straight line
    constexpr double longest = 8;     // [px] of a side that replaces others
    SvgPath out;
    PicturePoint a;  // the last point of the path
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const PicturePoint p = plot.at(line.points[i]);
        if (i > 0 && i + 1 < line.points.size()) {
            const PicturePoint b = plot.at(line.points[i + 1]);
            const double side = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
            const double twice = std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
            const double to_p = std::sqrt((p.x - a.x) * (p.x - a.x) + (p.y - a.y) * (p.y - a.y));
            if (side < longest && to_p <= side && twice <= visible * side) continue;
        }
        i == 0 ? out.move(p.x, p.y) : out.line(p.x, p.y);
        a = p;
    }
    if (line.closed) out.close();
    return out.text();
}

void draw_line(Svg& svg, const std::string& data, bool dashed) {
    svg.add("path", {{"d", data},
                     {"fill", "none"},
                     {"stroke", "#ffffff"},
                     {"stroke-width", contour_seam},
                     {"stroke-opacity", 0.7},
                     {"stroke-linejoin", "round"}});
    svg.add("path", {{"d", data},
                     {"fill", "none"},
                     {"stroke", contour_color},
                     {"stroke-width", contour_width},
                     {"stroke-linejoin", "round"},
                     {"stroke-dasharray", dashed ? "7 4" : "none"}});
}

/// The colours of the bar, from its lower to its upper end.
void define_gradient(Svg& svg) {
    constexpr int stops = 12;
    svg.open("linearGradient",
             {{"id", "levels"}, {"x1", 0.0}, {"y1", 1.0}, {"x2", 0.0}, {"y2", 0.0}});
    for (int i = 0; i <= stops; ++i) {
        const double share = i / static_cast<double>(stops);
        svg.add("stop",
                {{"offset", fmt::format("{:.4f}", share)}, {"stop-color", lagoon.at(share)}});
    }
    svg.close();
}

}  // namespace

HeatLayer::HeatLayer(std::span<const Transmitter> transmitters, const Plot& plot, int cells)
    : map_(coverage(transmitters, plot.low, plot.high, cells)) {
    std::set<double> ranges;
    for (const Transmitter& each : transmitters) {
        if (const auto range = range_of(each.model)) ranges.insert(range->value);
    }
    ranges_.assign(ranges.begin(), ranges.end());
    const std::vector<ContourLevel> levels = contour_levels(transmitters.front());
    std::tie(low_, high_) = color_range(map_, levels);
    for (const ContourLevel& each : levels)
        lines_.push_back({each.level, each.meaning, !lines_.empty()});

    constexpr double smoothing = 3;  // [px]: what is narrower than a line's width is not seen
    for (auto& line : lines_) {
        line.contours = contours(map_, line.level, {smoothing / plot.scale});
    }
}

void HeatLayer::draw_levels(Svg& svg, const Plot& plot) const {
    const std::string png = to_png(image_of(map_, low_, high_));
    svg.add("image", {{"x", plot.left},
                      {"y", plot.top},
                      {"width", plot.width},
                      {"height", plot.height},
                      {"preserveAspectRatio", "none"},
                      {"xlink:href", "data:image/png;base64," + base64(png)}});
}

void HeatLayer::draw_contours(Svg& svg, const Plot& plot) const {
    for (const auto& line : lines_) {
        std::string data;
        for (const ContourLine& each : line.contours) data += path_of(each, plot);
        if (!data.empty()) draw_line(svg, data, line.dashed);
    }
}

void HeatLayer::draw_bar(Svg& svg, PicturePoint corner, double height) const {
    constexpr double bar = 14, unit = 18;  // [px] width of the bar, room for the unit above it
    constexpr double text = 11, baseline = 4;
    constexpr int most_ticks = 9;
    const double top = corner.y + unit, length = height - unit;
    define_gradient(svg);
    svg.text(corner.x, corner.y + text - 1, "dBm", {.size = text});
    svg.add("rect", {{"x", corner.x},
                     {"y", top},
                     {"width", bar},
                     {"height", length},
                     {"fill", "url(#levels)"},
                     {"stroke", "#333333"},
                     {"stroke-width", 0.8}});
    const auto place = [&](double dbm) { return top + length * (high_ - dbm) / (high_ - low_); };
    SvgPath ticks;
    for (const double dbm : round_ticks(low_, high_, most_ticks)) {
        ticks.move(corner.x + bar, place(dbm)).horizontal(corner.x + bar + 4);
        svg.text(corner.x + bar + 7, place(dbm) + baseline, fmt::format("{:.6g}", dbm),
                 {.size = text});
    }
    svg.add("path", {{"d", ticks.text()}, {"stroke", "#333333"}, {"stroke-width", 1.0}});
    for (const auto& line : lines_) {
        if (line.level.value < low_ || line.level.value > high_) continue;
        SvgPath mark;
        mark.move(corner.x - 3, place(line.level.value)).horizontal(corner.x + bar + 3);
        draw_line(svg, mark.text(), line.dashed);
    }
}

void HeatLayer::append_to(Legend& legend) const {
    for (const auto& line : lines_) {
        legend.add({has_levels() ? fmt::format("{:.6g} dBm, {}", line.level.value, line.meaning)
                                 : fmt::format("range of {:.6g} m", fmt::join(ranges_, " m or ")),
                    26, [dashed = line.dashed](Svg& svg, PicturePoint p) {
                        SvgPath path;
                        path.move(p.x, p.y).horizontal(p.x + 26);
                        draw_line(svg, path.text(), dashed);
                    }});
    }
}

}  // namespace rovernet
