// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_legend.hpp"

#include "pictures/chart/chart_heat_map.hpp"
#include "pictures/chart/chart_marks.hpp"
#include "pictures/chart/chart_panel.hpp"
#include "pictures/chart/chart_style.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

constexpr double line_length = 30;  // [px]
constexpr double sign_size = 12;    // [px] of the others

void draw_line_sign(Svg& svg, PicturePoint p, const ChartStyle& style, bool mark) {
    SvgPath path;
    path.move(p.x, p.y).horizontal(p.x + line_length);
    svg.add("path", {{"d", path.text()},
                     {"stroke", style.color},
                     {"stroke-width", 1.8},
                     {"stroke-dasharray", style.dash_text()}});
    if (mark) draw_mark(svg, {p.x + line_length / 2, p.y}, style, "");
}

void draw_bar_sign(Svg& svg, PicturePoint p, std::size_t series) {
    svg.add("rect", {{"x", p.x},
                     {"y", p.y - sign_size / 2},
                     {"width", sign_size},
                     {"height", sign_size},
                     {"fill", bar_color(series)},
                     {"stroke", chart_style(series).color}});
}

void draw_missing_sign(Svg& svg, PicturePoint p) {
    SvgPath path;
    append_cross(path, {p.x, p.y - sign_size / 2, p.x + sign_size, p.y + sign_size / 2});
    svg.add("path", {{"d", path.text()}, {"stroke", missing_color}, {"stroke-width", 0.8}});
}

LegendItem item(const Chart& chart, const ChartView& view, std::size_t series, bool marks) {
    const ChartStyle style = style_in(chart, series);
    const bool lines =
        (chart.kind == ChartKind::lines || chart.kind == ChartKind::cdf) && !style.hollow;
    const bool bars = chart.kind == ChartKind::bars && !view.dots;
    return {.text = {},
            .width = lines ? line_length : sign_size,
            .draw = [=](Svg& svg, PicturePoint p) {
                if (lines) {
                    draw_line_sign(svg, p, style, marks);
                } else if (bars) {
                    draw_bar_sign(svg, p, series);
                } else {
                    draw_mark(svg, {p.x + sign_size / 2, p.y}, style, "");
                }
            }};
}

}  // namespace

Legend chart_legend(const Chart& chart, const ChartView& view, bool marks, double width) {
    constexpr std::size_t most = 40;  // series
    Legend legend;
    if (chart.kind == ChartKind::heat_map) {
        if (view.points > 0 && has_missing_cells(view)) {
            legend.add({"no value", sign_size, draw_missing_sign});
        }
        return legend;
    }
    if (!chart.legend_title.empty() && !chart.series.empty()) {
        legend.add({.text = fitted(chart.legend_title, width / 2, chart_text_size), .width = 0});
    }
    for (std::size_t i = 0; i < std::min(chart.series.size(), most); ++i) {
        LegendItem sign = item(chart, view, i, marks && chart.kind == ChartKind::lines);
        sign.text = fitted(chart.series[i].name, width - 2 * line_length, chart_text_size);
        if (!sign.text.empty()) legend.add(std::move(sign));
    }
    if (chart.series.size() > most) {
        legend.add({fmt::format("and {} more, not listed", chart.series.size() - most), 0,
                    [](Svg&, PicturePoint) {}});
    }
    return legend;
}

}  // namespace rovernet
