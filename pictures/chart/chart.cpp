// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"

#include "pictures/chart/chart_panel.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double margin = ChartLayout::margin;
constexpr double title_size = 17, title_height = 30;

void check(const ChartLayout& layout) {
    constexpr double least_width = 200, least_height = 80, most = 10'000;
    const auto fault = [=](const char* what, double v, double least) {
        return std::invalid_argument(
            fmt::format("ChartLayout: {} must be {} to {}, got {}", what, least, most, v));
    };
    if (!(layout.width >= least_width && layout.width <= most)) {
        throw fault("width [px]", layout.width, least_width);
    }
    if (!(layout.height >= least_height && layout.height <= most)) {
        throw fault("height [px]", layout.height, least_height);
    }
    if (!(layout.columns >= 1 && layout.columns <= most)) {
        throw fault("columns", layout.columns, 1);
    }
}

/// Row of charts side by side, with plot areas at the same height.
struct Row {
    std::vector<ChartPanel> panels = {};
    double head = 0, foot = 0;  // [px]

    void add(ChartPanel panel) {
        head = std::max(head, panel.head());
        foot = std::max(foot, panel.foot());
        panels.push_back(std::move(panel));
    }
};

std::vector<Row> rows_of(std::span<const Chart> charts, const ChartLayout& layout) {
    std::vector<Row> rows;
    const auto columns = static_cast<std::size_t>(layout.columns);
    for (std::size_t i = 0; i < charts.size(); ++i) {
        if (i % columns == 0) rows.emplace_back();
        rows.back().add(ChartPanel(charts[i], layout, i));
    }
    return rows;
}

}  // namespace

std::string chart_svg(std::span<const Chart> panels, const ChartLayout& layout) {
    check(layout);
    const Chart nothing;
    if (panels.empty()) panels = {&nothing, 1};
    const std::vector<Row> rows = rows_of(panels, layout);
    const int columns = static_cast<int>(rows.front().panels.size());
    const double top = margin + (layout.title.empty() ? 0 : title_height);
    const double width = layout.picture_width(columns);
    double height = top;
    for (const auto& row : rows) height += row.head + layout.height + row.foot + margin;

    Svg svg(width, height, layout.scale);
    svg.add("rect", {{"width", width}, {"height", height}, {"fill", "#ffffff"}});
    svg.text(width / 2, margin + title_size, fitted(layout.title, width - 2 * margin, title_size),
             {.size = title_size, .anchor = TextAnchor::middle, .bold = true});
    double y = top;
    for (const auto& row : rows) {
        y += row.head;
        double x = margin;
        for (const auto& panel : row.panels) {
            panel.draw(svg, {x, y}, row.head);
            x += layout.width + 2 * margin;
        }
        y += layout.height + row.foot + margin;
    }
    return svg.finish();
}

}  // namespace rovernet
