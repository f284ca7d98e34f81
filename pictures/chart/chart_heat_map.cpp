// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_heat_map.hpp"

#include "pictures/chart/chart_style.hpp"
#include "pictures/draw/color.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace rovernet {
namespace {

constexpr const char* edge = "#333333";

/// Values of one row by column; the last of several values for a cell is used.
std::vector<const DrawnPoint*> row_of(const ChartView& view, std::size_t row) {
    std::vector<const DrawnPoint*> out(view.words.size(), nullptr);
    for (const auto& p : view.series[row]) out[static_cast<std::size_t>(p.x)] = &p;
    return out;
}

void draw_value(Svg& svg, const Box& cell, const std::string& text, bool dark) {
    constexpr double text_margin = 4;  // [px]
    if (text_width(text, chart_text_size) > cell.right - cell.left - text_margin) return;
    if (chart_text_size + text_margin > cell.bottom - cell.top) return;
    svg.text((cell.left + cell.right) / 2, (cell.top + cell.bottom) / 2 + text_drop, text,
             {.size = chart_text_size,
              .anchor = TextAnchor::middle,
              .color = dark ? Color{0x11, 0x11, 0x11} : Color{0xff, 0xff, 0xff}});
}

void draw_cell(Svg& svg, const Box& cell, const ChartAxis& colors, double v, bool dark) {
    constexpr double seam = 0.5;  // [px] over the edge, where else white would shine through
    const Color color = lagoon.at(colors.share(v));
    svg.add("rect", {{"class", "cell"},
                     {"x", cell.left},
                     {"y", cell.top},
                     {"width", cell.right - cell.left},
                     {"height", cell.bottom - cell.top},
                     {"fill", color},
                     {"stroke", color},
                     {"stroke-width", seam}});
    draw_value(svg, cell, colors.text(v), dark);
}

}  // namespace

void append_cross(SvgPath& path, const Box& box) {
    path.move(box.left, box.bottom).line(box.right, box.top);
    path.move(box.left, box.top).line(box.right, box.bottom);
}

double dark_text_from(const ChartAxis& colors) {
    constexpr double middle = 0.18;  // luminance on which black and white are read alike
    constexpr int steps = 100;
    int step = 0;
    while (step < steps && luminance(lagoon.at(step / double{steps})) < middle) ++step;
    return colors.low + step * (colors.high - colors.low) / steps;
}

bool has_missing_cells(const ChartView& view) {
    for (std::size_t row = 0; row < view.series.size(); ++row) {
        const auto values = row_of(view, row);
        if (std::find(values.begin(), values.end(), nullptr) != values.end()) return true;
    }
    return false;
}

void draw_cells(Svg& svg, const ChartView& view, const ChartFrame& frame, const ChartAxis& colors) {
    const Box& box = frame.box;
    const double width = (box.right - box.left) / static_cast<double>(view.words.size());
    const double height = (box.bottom - box.top) / static_cast<double>(view.series.size());
    const double dark_from = dark_text_from(colors);
    SvgPath missing;
    svg.open("g", {{"class", "cells"}});
    for (std::size_t row = 0; row < view.series.size(); ++row) {
        const auto values = row_of(view, row);
        const double bottom = box.bottom - static_cast<double>(row) * height;
        for (std::size_t column = 0; column < values.size(); ++column) {
            const double left = box.left + static_cast<double>(column) * width;
            const Box cell{left, bottom - height, left + width, bottom};
            if (const DrawnPoint* p = values[column]) {
                draw_cell(svg, cell, colors, p->y, p->y >= dark_from);
            } else {
                append_cross(missing, cell);
            }
        }
    }
    svg.close();
    if (missing.empty()) return;
    svg.add("path", {{"class", "missing"},
                     {"d", missing.text()},
                     {"stroke", missing_color},
                     {"stroke-width", 0.8}});
}

void draw_color_bar(Svg& svg, const ChartFrame& frame, const ChartAxis& colors,
                    std::size_t number) {
    constexpr double gap = 16, width = 14;  // [px] before the bar, and of it
    constexpr int stops = 12;
    const std::string id = fmt::format("colors{}", number);
    const double left = frame.box.right + gap, top = frame.box.top;
    const double height = frame.box.bottom - top;
    svg.open("linearGradient", {{"id", id}, {"x1", 0.0}, {"y1", 1.0}, {"x2", 0.0}, {"y2", 0.0}});
    for (int i = 0; i <= stops; ++i) {
        const double share = i / static_cast<double>(stops);
        svg.add("stop",
                {{"offset", fmt::format("{:.4f}", share)}, {"stop-color", lagoon.at(share)}});
    }
    svg.close();
    svg.add("rect", {{"class", "colors"},
                     {"x", left},
                     {"y", top},
                     {"width", width},
                     {"height", height},
                     {"fill", fmt::format("url(#{})", id)},
                     {"stroke", edge},
                     {"stroke-width", 0.8}});
    SvgPath ticks;
    for (const auto& tick : colors.ticks) {
        const double y = frame.box.bottom - colors.share(tick.value) * height;
        ticks.move(left + width, y).horizontal(left + width + 4);
        svg.text(left + width + 7, y + text_drop, tick.text, {.size = chart_text_size});
    }
    svg.add("path", {{"d", ticks.text()}, {"stroke", edge}, {"stroke-width", 1.0}});
}

}  // namespace rovernet
