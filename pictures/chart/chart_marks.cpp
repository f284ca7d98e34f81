// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_marks.hpp"

#include "pictures/chart/chart_guides.hpp"
#include "pictures/chart/chart_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace rovernet {
namespace {

constexpr double mark_radius = 3.6;        // [px]
constexpr double mark_room = 5.1;          // [px] half a mark of any shape, with its edge
constexpr double small_mark_radius = 1.6;  // [px] where there are many
constexpr double line_width = 1.8;         // [px]
constexpr double whisker_width = 1.3;      // [px]
constexpr double cap = 3;                  // [px] half the width of a whisker's ends
constexpr double beside = 9;               // [px] between points that would hide one another
constexpr std::size_t most_tips = 1000;    // of a chart, so that large ones stay small files
constexpr Color whisker_color{0x22, 0x22, 0x22};

/// Tooltip of a point: series, position, interval and count.
std::string tip_of(const Chart& chart, const ChartView& view, std::size_t series,
                   const DrawnPoint& p) {
    if (view.points > most_tips) return "";
    const std::string x =
        view.has_words ? view.words[static_cast<std::size_t>(p.x)] : number_text(p.x);
    std::string out = fmt::format("{}: {}, {}", chart.series[series].name, x, number_text(p.y));
    if (p.low && p.high) {
        out += fmt::format(" ({} to {})", number_text(*p.low), number_text(*p.high));
    }
    if (p.source->n > 0) out += fmt::format(", n = {}", p.source->n);
    if (!p.source->label.empty()) out = p.source->label + ", " + out;
    return out;
}

void add_path(Svg& svg, const char* what, const SvgPath& path, Color stroke, double width,
              const std::string& dashes = "none") {
    if (path.empty()) return;
    svg.add("path", {{"class", what},
                     {"d", path.text()},
                     {"fill", "none"},
                     {"stroke", stroke},
                     {"stroke-width", width},
                     {"stroke-linejoin", "round"},
                     {"stroke-dasharray", dashes}});
}

/// Appends a whisker at px from one end of the interval to the other, or to the point; an end
/// beyond the axis has no cap.
void append_whisker(SvgPath& path, const ChartFrame& frame, const DrawnPoint& p, double px) {
    if (!p.low && !p.high) return;
    const double at_low = p.low.value_or(p.y), at_high = p.high.value_or(p.y);
    const auto shown = [&](double v) { return v >= frame.y.low && v <= frame.y.high; };
    const double low = at_low < frame.y.low ? frame.box.bottom : frame.at(p.x, at_low).y;
    const double high = at_high > frame.y.high ? frame.box.top : frame.at(p.x, at_high).y;
    path.move(px, low).vertical(high);
    if (p.low && shown(*p.low)) path.move(px - cap, low).horizontal(px + cap);
    if (p.high && shown(*p.high)) path.move(px - cap, high).horizontal(px + cap);
}

/// Places of the points of a series from left to right [px].
using Places = std::vector<double>;

/// Places at x of the points, plus an offset [px].
Places places_of(const std::vector<DrawnPoint>& points, const ChartFrame& frame, double shift) {
    Places out;
    for (const auto& p : points) out.push_back(frame.at(p.x, p.y).x + shift);
    return out;
}

/// Box that a point and its whisker cover [px], with the room that they need.
Box cover(const DrawnPoint& p, const ChartFrame& frame, double px) {
    const double reach = mark_radius + 0.5;
    const double y = frame.at(p.x, p.y).y;
    const double top = frame.at(p.x, p.high.value_or(p.y)).y;
    const double bottom = frame.at(p.x, p.low.value_or(p.y)).y;
    return {px - reach, std::min(top, y - reach), px + reach, std::max(bottom, y + reach)};
}

/// Draws the marks of a series, in one path if there are too many for tips.
void draw_marks(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame,
                std::size_t series, const Places& places) {
    const ChartStyle style = style_in(chart, series);
    SvgPath all;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const DrawnPoint& p = view.series[series][i];
        const PicturePoint at{places[i], frame.at(p.x, p.y).y};
        if (view.points > most_tips) {
            style.marker.append_to(all, at, small_mark_radius);
        } else {
            draw_mark(svg, at, style, tip_of(chart, view, series, p));
        }
    }
    if (!all.empty()) {
        svg.add("path", {{"class", "marks"}, {"d", all.text()}, {"fill", style.color}});
    }
}

/// End of a run of points that are joined and have both ends of an interval; `begin` if there is
/// none.
std::size_t end_of_run(const std::vector<DrawnPoint>& points, std::size_t begin) {
    std::size_t end = begin;
    while (end < points.size() && points[end].low && points[end].high &&
           (end == begin || points[end].joined)) {
        ++end;
    }
    return end;
}

/// The intervals of a line: bands where neighbours have them, whiskers elsewhere.
void draw_intervals(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame,
                    std::size_t series, const Places& places) {
    const auto& points = view.series[series];
    const Color color = style_in(chart, series).color;
    SvgPath band, whiskers;
    for (std::size_t i = 0; i < points.size();) {
        const std::size_t end = end_of_run(points, i);
        if (!has_band(view, series) || end < i + 2) {
            append_whisker(whiskers, frame, points[i], places[i]);
            ++i;
            continue;
        }
        for (std::size_t k = i; k < end; ++k) {
            const PicturePoint at = frame.at(points[k].x, *points[k].high);
            k == i ? band.move(at.x, at.y) : band.line(at.x, at.y);
        }
        for (std::size_t k = end; k-- > i;) {
            const PicturePoint at = frame.at(points[k].x, *points[k].low);
            band.line(at.x, at.y);
        }
        band.close();
        i = end;
    }
    if (!band.empty()) {
        svg.add("path",
                {{"class", "band"}, {"d", band.text()}, {"fill", color}, {"fill-opacity", 0.16}});
    }
    add_path(svg, "whisker", whiskers, color, whisker_width);
}

/// Whether a point has no line on either side.
bool any_alone(const std::vector<DrawnPoint>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool goes_on = i + 1 < points.size() && points[i + 1].joined;
        if (!points[i].joined && !goes_on) return true;
    }
    return false;
}

void draw_bar(Svg& svg, double left, double right, double from, double to, std::size_t series,
              const std::string& tip) {
    constexpr double least_edged = 4;  // [px]
    const bool edged = right - left >= least_edged;
    svg.open("rect", {{"class", "bar"},
                      {"x", left},
                      {"y", std::min(from, to)},
                      {"width", right - left},
                      {"height", std::max(from, to) - std::min(from, to)},
                      {"fill", bar_color(series)},
                      {"stroke", edged ? hex(chart_style(series).color) : "none"}});
    if (!tip.empty()) svg.title(tip);
    svg.close();
}

/// Offset between the series of a line chart [px]; 0 if whiskers and marks do not overlap, or if
/// there are no whiskers: intervals are bands, or none are given.
std::vector<double> shifts(const ChartView& view, const ChartFrame& frame) {
    std::vector<double> out(view.series.size(), 0);
    std::vector<std::pair<double, Box>> covers;  // of all points, and their x
    bool has_whiskers = false;
    double room = frame.box.right - frame.box.left;
    std::set<double> all_x;
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        if (has_band(view, i) || view.points > most_tips) return out;
        for (const auto& p : view.series[i]) {
            covers.emplace_back(p.x, cover(p, frame, 0));
            has_whiskers = has_whiskers || p.low || p.high;
            all_x.insert(frame.at(p.x, p.y).x);
        }
    }
    for (auto it = all_x.begin(); it != all_x.end() && std::next(it) != all_x.end(); ++it)
        room = std::min(room, *std::next(it) - *it);
    if (!has_whiskers) return out;
    bool hidden = false;
    for (std::size_t i = 0; i < covers.size() && !hidden; ++i) {
        for (std::size_t k = 0; k < i && !hidden; ++k) {
            hidden =
                covers[i].first == covers[k].first && covers[i].second.overlaps(covers[k].second);
        }
    }
    if (!hidden) return out;
    const auto count = static_cast<double>(view.series.size());
    const double step = std::min(beside, 0.6 * room / count);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = step * (static_cast<double>(i) - (count - 1) / 2);
    return out;
}

/// Places of the points of a scatter: at x, or as near as possible without covering an earlier
/// point.
std::vector<Places> apart(const ChartView& view, const ChartFrame& frame) {
    constexpr int most_steps = 2;  // a measured x is not moved farther than 18 px
    std::vector<Places> out;
    std::vector<Box> taken;
    for (const auto& points : view.series) {
        out.push_back(places_of(points, frame, 0));
        if (view.points > most_tips) continue;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double x = out.back()[i];
            for (int n = 0; n <= 2 * most_steps; ++n) {
                const double at = x + beside * (n % 2 == 0 ? 1 : -1) * ((n + 1) / 2);
                const Box box = cover(points[i], frame, at);
                const bool fits =
                    at - mark_room >= frame.box.left && at + mark_room <= frame.box.right;
                const bool free = std::none_of(taken.begin(), taken.end(),
                                               [&](const Box& b) { return b.overlaps(box); });
                if (!fits || !free) continue;
                out.back()[i] = at;
                break;
            }
            taken.push_back(cover(points[i], frame, out.back()[i]));
        }
    }
    return out;
}

/// Keeps labels of a scatter off its marks and whiskers.
void keep_marks_free(LabelPlaces& free, const ChartView& view, const ChartFrame& frame,
                     const std::vector<Places>& places) {
    constexpr double reach = mark_radius + 1;  // [px]
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < places[i].size(); ++k) {
            const DrawnPoint& p = view.series[i][k];
            const double x = places[i][k], y = frame.at(p.x, p.y).y;
            free.keep_free({x - reach, y - reach, x + reach, y + reach});
            if (!p.low && !p.high) continue;
            free.keep_free({x - cap, frame.at(p.x, p.high.value_or(p.y)).y, x + cap,
                            frame.at(p.x, p.low.value_or(p.y)).y});
        }
    }
}

/// A free place for the label of a point: beside its mark, or else below or above its whisker.
std::optional<Box> place_of_label(LabelPlaces& free, const ChartFrame& frame, const DrawnPoint& p,
                                  double x, double width, double height) {
    const double y = frame.at(p.x, p.y).y;
    auto box = free.place({x, y}, mark_radius + 1, width, height);
    for (const auto& [end, below] : {std::pair{p.low, true}, std::pair{p.high, false}}) {
        if (box || !end) continue;
        box = free.place_at_end({x, frame.at(p.x, *end).y}, below, width, height);
    }
    return box;
}

}  // namespace

PicturePoint ChartFrame::at(double x_value, double y_value) const {
    const double left = box.left + inset, width = box.right - box.left - 2 * inset;
    const double bottom = box.bottom - rise, height = bottom - rise - box.top;
    return {left + x.share(x_value) * width, bottom - y.share(y_value) * height};
}

Color bar_color(std::size_t series) {
    constexpr double share = 0.75;  // of the series' colour, on white
    return blend(chart_style(series).color, {255, 255, 255}, share);
}

void draw_mark(Svg& svg, PicturePoint at, const ChartStyle& style, const std::string& tip) {
    SvgPath path;
    style.marker.append_to(path, at, mark_radius);
    svg.open("path", {{"class", "mark"},
                      {"d", path.text()},
                      {"fill", style.hollow ? Color{255, 255, 255} : style.color},
                      {"stroke", style.hollow ? style.color : Color{255, 255, 255}},
                      {"stroke-width", style.hollow ? 1.4 : 0.7}});
    if (!tip.empty()) svg.title(tip);
    svg.close();
}

double reach_of_marks(const Chart& chart, const ChartView& view, const ChartFrame& frame) {
    double most = 0;
    if (chart.kind == ChartKind::lines)
        for (const double shift : shifts(view, frame)) most = std::max(most, std::abs(shift));
    return most + mark_room;
}

double rise_of_marks(const Chart& chart, const ChartView& view) {
    const bool has_marks = chart.kind == ChartKind::lines || chart.kind == ChartKind::scatter ||
                           (chart.kind == ChartKind::bars && view.dots);
    return has_marks ? mark_room : 0;
}

bool room_for_marks(const ChartView& view, const ChartFrame& frame) {
    constexpr double spacing = 12;  // [px] from mark to mark
    std::size_t longest = 0;
    for (const auto& points : view.series) longest = std::max(longest, points.size());
    return static_cast<double>(longest) * spacing <= frame.box.right - frame.box.left;
}

void draw_lines(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame) {
    const std::vector<double> beside_x = shifts(view, frame);
    std::vector<Places> places;
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        places.push_back(places_of(view.series[i], frame, beside_x[i]));
        draw_intervals(svg, chart, view, frame, i, places[i]);
    }
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        const ChartStyle style = style_in(chart, i);
        SvgPath line;
        for (std::size_t k = 0; k < places[i].size(); ++k) {
            const DrawnPoint& p = view.series[i][k];
            const double x = places[i][k], y = frame.at(p.x, p.y).y;
            p.joined ? line.line(x, y) : line.move(x, y);
        }
        add_path(svg, "line", line, style.color, line_width, style.dash_text());
        if (room_for_marks(view, frame) || any_alone(view.series[i])) {
            draw_marks(svg, chart, view, frame, i, places[i]);
        }
    }
}

void draw_bars(Svg& svg, const Chart& chart, const ChartView& view, const ChartFrame& frame) {
    const std::size_t count = view.series.size();
    const double half = 0.5 * bars_at_word / static_cast<double>(std::max<std::size_t>(count, 1));
    for (std::size_t i = 0; i < count; ++i) {
        const double offset = bar_offset(i, count);
        SvgPath whiskers;
        for (const auto& p : view.series[i]) {
            append_whisker(whiskers, frame, p, frame.at(p.x + offset, p.y).x);
            if (view.dots) continue;
            const PicturePoint left = frame.at(p.x + offset - half, 0);
            const PicturePoint right = frame.at(p.x + offset + half, p.y);
            draw_bar(svg, left.x, right.x, left.y, right.y, i, tip_of(chart, view, i, p));
        }
        add_path(svg, "whisker", whiskers, view.dots ? chart_style(i).color : whisker_color,
                 whisker_width);
        if (!view.dots) continue;
        Places places;
        for (const auto& p : view.series[i]) places.push_back(frame.at(p.x + offset, p.y).x);
        draw_marks(svg, chart, view, frame, i, places);
    }
}

std::size_t draw_scatter(Svg& svg, const Chart& chart, const ChartView& view,
                         const ChartFrame& frame) {
    constexpr double size = 11, descent = 3;  // [px] of the labels
    constexpr std::size_t most_characters = 40;
    const std::vector<Places> places = apart(view, frame);
    LabelPlaces free(frame.box);
    keep_marks_free(free, view, frame, places);
    draw_band(svg, chart, frame, free);
    draw_guides(svg, chart, frame, free);
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        SvgPath whiskers = x_whiskers(view, i, frame, free);
        for (std::size_t k = 0; k < places[i].size(); ++k) {
            append_whisker(whiskers, frame, view.series[i][k], places[i][k]);
        }
        add_path(svg, "whisker", whiskers, chart_style(i).color, whisker_width);
        draw_marks(svg, chart, view, frame, i, places[i]);
    }
    std::size_t homeless = 0;
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        for (std::size_t k = 0; k < places[i].size(); ++k) {
            const DrawnPoint& p = view.series[i][k];
            const std::string label = shortened(p.source->label, most_characters);
            if (label.empty()) continue;
            const auto box = place_of_label(free, frame, p, places[i][k], text_width(label, size),
                                            size + descent);
            if (box)
                svg.text(box->left, box->bottom - descent, label, {.size = size, .halo = true});
            homeless += !box;
        }
    }
    return homeless;
}

void draw_cdf(Svg& svg, const ChartView& view, const ChartFrame& frame) {
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        if (view.series[i].empty()) continue;
        SvgPath path;
        path.move(frame.box.left, frame.box.bottom);
        double height = frame.box.bottom;
        for (const auto& p : view.series[i]) {
            const PicturePoint at = frame.at(p.x, p.y);
            path.horizontal(at.x).vertical(at.y);
            height = at.y;
        }
        if (height < frame.box.bottom) path.horizontal(frame.box.right);
        add_path(svg, "line", path, chart_style(i).color, line_width, chart_style(i).dash_text());
    }
}

}  // namespace rovernet
