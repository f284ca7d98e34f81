// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_guides.hpp"

#include "pictures/chart/chart_style.hpp"

namespace rovernet {
namespace {

constexpr const char* guide_color = "#9a9a9a";

}  // namespace

void draw_band(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels) {
    if (!chart.band) return;
    constexpr double inset = 6, rise = 5;  // [px] of its words
    const Box& box = frame.box;
    const double top = frame.at(frame.x.low, *chart.band).y;
    svg.add("rect", {{"class", "limit"},
                     {"x", box.left},
                     {"y", top},
                     {"width", box.right - box.left},
                     {"height", box.bottom - top},
                     {"fill", chart_band_color}});
    const double width = text_width(chart.band_label, chart_text_size);
    const double baseline = box.bottom - rise;
    svg.text(box.right - inset, baseline, chart.band_label,
             {.size = chart_text_size, .anchor = TextAnchor::end});
    labels.keep_free(
        {box.right - inset - width, baseline - chart_text_size, box.right, box.bottom});
}

void draw_guides(Svg& svg, const Chart& chart, const ChartFrame& frame, LabelPlaces& labels) {
    for (const ChartGuide& guide : chart.guides) {
        SvgPath path;
        PicturePoint last;
        for (const ChartPoint& point : guide.points) {
            const PicturePoint at = frame.at(point.x, point.y);
            if (path.empty()) {
                path.move(at.x, at.y);
            } else {
                path.line(at.x, at.y);
                labels.avoid(last, at);
            }
            last = at;
        }
        svg.add("path", {{"class", "guide"},
                         {"d", path.text()},
                         {"fill", "none"},
                         {"stroke", guide_color},
                         {"stroke-width", 1.2},
                         {"stroke-dasharray", guide.dashed ? "5 4" : "none"}});
    }
}

SvgPath x_whiskers(const ChartView& view, std::size_t series, const ChartFrame& frame,
                   LabelPlaces& labels) {
    SvgPath path;
    for (const DrawnPoint& p : view.series[series]) {
        if (!p.source->x_low || !p.source->x_high) continue;
        const PicturePoint low = frame.at(*p.source->x_low, p.y);
        const PicturePoint high = frame.at(*p.source->x_high, p.y);
        path.move(low.x, low.y).horizontal(high.x);
        labels.avoid(low, high);
    }
    return path;
}

}  // namespace rovernet
