// SPDX-License-Identifier: MIT
#include "pictures/chart/dot_plot.hpp"

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_marks.hpp"
#include "pictures/chart/chart_panel.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

constexpr double around = ChartLayout::margin;     // [px] around each plot
constexpr double row_height = 20;                  // [px]
constexpr double head_size = 17, head_room = 30;   // [px] of the picture's title
constexpr double title_room = 24, axis_room = 40;  // [px]
constexpr double name_gap = 10;                    // [px] from a name to the scale
constexpr double between = 18;                     // [px] between the scales
constexpr double share_beside = 0.28;              // of the width
constexpr double end_room = 8;  // [px] so that no dot stands on an end of a scale
constexpr double band_sign = 12, whisker_sign = 18;  // [px] in the legend
constexpr const char *stripe = "#f6f6f6", *join_color = "#8a8a8a";

/// A scale along x.
struct Scale {
    ChartAxis axis;
    double left = 0, right = 0;  // [px]

    double at(double v) const {
        return left + end_room + axis.share(v) * (right - left - 2 * end_room);
    }
};

ChartAxis axis_of(const ChartRange& range, bool log, double length, const ChartLimits& limits) {
    constexpr double tick_spacing = 44;  // [px]
    const int most = static_cast<int>(std::clamp(length / tick_spacing, 3.0, 9.0));
    return number_axis(range, log, most, limits);
}

/// Draws an interval along x, with a tick at each end.
void add_whisker(Svg& svg, double low, double high, double y, const SvgAttribute& stroke) {
    constexpr double tick = 2.5;  // [px]
    SvgPath path;
    path.move(low, y).horizontal(high);
    path.move(low, y - tick).vertical(y + tick).move(high, y - tick).vertical(y + tick);
    svg.add("path", {{"class", "whisker"}, {"d", path.text()}, stroke, {"stroke-width", 1.1}});
}

/// A plot with its places, from its upper left corner.
class DotPanel {
  public:
    DotPanel(const DotPlot& plot, double wide) : plot_(plot), width_(wide) {
        constexpr double most_name = 0.34;  // of the width
        constexpr double wider = 1.1;       // a bold text
        for (const DotRow& row : plot.rows)
            name_ =
                std::max(name_, (row.bold ? wider : 1) * text_width(row.name, chart_label_size));
        name_ = std::min(name_, most_name * wide);
        beside_ = {{}, wide * (1 - share_beside), wide};
        value_ = {{}, name_ + name_gap, beside_.left - between};
        ChartRange values, costs;
        for (const DotRow& row : plot.rows) {
            for (const Dot& dot : row.dots) {
                values.include(shown(dot.value));
                if (dot.low) values.include(shown(*dot.low));
                if (dot.high) values.include(shown(*dot.high));
                costs.include(dot.beside);
            }
        }
        if (plot.band) values.include(shown(*plot.band));
        if (!plot.log) values.include(0);
        const ChartLimits limits{.low = plot.log ? plot.least : 0};
        value_.axis = axis_of(values, plot.log, value_.right - value_.left, limits);
        beside_.axis = axis_of(costs, true, beside_.right - beside_.left, {});
        part_ticks();
        add_legend();
        if (!plot.note.empty()) notes_ = wrapped({plot.note}, wide, chart_text_size);
    }

    double height() const {
        return top() + rows() + axis_room + legend_.height(width_) +
               static_cast<double>(notes_.size()) * chart_line_height;
    }

    void draw(Svg& svg, double x, double y) const {
        svg.open("g",
                 {{"class", "panel"},
                  {"transform", fmt::format("translate({} {})", svg_number(x), svg_number(y))}});
        svg.text(width_ / 2, chart_title_size, fitted(plot_.title, width_, chart_title_size),
                 {.size = chart_title_size, .anchor = TextAnchor::middle, .bold = true});
        draw_rows(svg);
        draw_band(svg);
        draw_scale(svg, value_, plot_.value_label);
        draw_scale(svg, beside_, plot_.beside_label);
        for (std::size_t i = 0; i < plot_.rows.size(); ++i) draw_dots(svg, i);
        draw_foot(svg);
        svg.close();
    }

  private:
    /// Explains the series, the band and the whiskers, as far as there are any.
    void add_legend() {
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            if (plot_.series[i].empty()) continue;
            legend_.add({plot_.series[i], 12, [i](Svg& svg, PicturePoint p) {
                             draw_mark(svg, {p.x + 6, p.y}, chart_style(i), "");
                         }});
        }
        if (plot_.band) {
            legend_.add({plot_.band_label, band_sign, [](Svg& svg, PicturePoint p) {
                             svg.add("rect", {{"x", p.x},
                                              {"y", p.y - band_sign / 2},
                                              {"width", band_sign},
                                              {"height", band_sign},
                                              {"fill", chart_band_color}});
                         }});
        }
        const bool has_whiskers =
            std::any_of(plot_.rows.begin(), plot_.rows.end(), [](const DotRow& row) {
                return std::any_of(row.dots.begin(), row.dots.end(),
                                   [](const Dot& dot) { return dot.low && dot.high; });
            });
        if (has_whiskers && !plot_.whisker_label.empty()) {
            legend_.add({plot_.whisker_label, whisker_sign, [](Svg& svg, PicturePoint p) {
                             add_whisker(svg, p.x, p.x + whisker_sign, p.y, {"stroke", chart_ink});
                         }});
        }
    }
    /// Moves the second scale to the right if its first number would touch the last number of the
    /// main scale.
    void part_ticks() {
        constexpr double least = 10;  // [px] between numbers
        if (value_.axis.ticks.empty() || beside_.axis.ticks.empty()) return;
        const ChartTick &last = value_.axis.ticks.back(), &first = beside_.axis.ticks.front();
        const double end = value_.at(last.value) + text_width(last.text, chart_text_size) / 2;
        const double begin = beside_.at(first.value) - text_width(first.text, chart_text_size) / 2;
        beside_.left += std::max(0.0, end + least - begin);
    }
    double shown(double v) const { return plot_.log ? std::max(v, plot_.least) : v; }
    double top() const { return plot_.title.empty() ? 6 : title_room; }
    double rows() const { return row_height * static_cast<double>(plot_.rows.size()); }
    double middle(std::size_t row) const {
        return top() + row_height * (static_cast<double>(row) + 0.5);
    }

    void draw_rows(Svg& svg) const {
        for (std::size_t i = 0; i < plot_.rows.size(); ++i) {
            const DotRow& row = plot_.rows[i];
            if (i % 2 == 0)
                svg.add("rect", {{"x", 0.0},
                                 {"y", middle(i) - row_height / 2},
                                 {"width", width_},
                                 {"height", row_height},
                                 {"fill", stripe}});
            svg.text(name_, middle(i) + text_drop, fitted(row.name, name_, chart_label_size),
                     {.size = chart_label_size, .anchor = TextAnchor::end, .bold = row.bold});
        }
    }

    void draw_band(Svg& svg) const {
        if (!plot_.band) return;
        const double right = value_.at(shown(*plot_.band)), bottom = top() + rows();
        svg.add("rect", {{"class", "limit"},
                         {"x", value_.left},
                         {"y", top()},
                         {"width", right - value_.left},
                         {"height", bottom - top()},
                         {"fill", chart_band_color}});
    }

    void draw_scale(Svg& svg, const Scale& scale, const std::string& label) const {
        const double bottom = top() + rows();
        SvgPath lines, axis;
        axis.move(scale.left, bottom).horizontal(scale.right);
        double end = -width_;
        for (const ChartTick& tick : scale.axis.ticks) {
            const double x = scale.at(tick.value);
            axis.move(x, bottom).vertical(bottom + 4);
            const double half = text_width(tick.text, chart_text_size) / 2;
            if (tick.text.empty() || x - half < end + 6) continue;
            end = x + half;
            lines.move(x, top()).vertical(bottom);
            svg.text(x, bottom + 16, tick.text,
                     {.size = chart_text_size, .anchor = TextAnchor::middle});
        }
        svg.add("path", {{"class", "grid"}, {"d", lines.text()}, {"stroke", chart_grid}});
        svg.add("path", {{"class", "axes"}, {"d", axis.text()}, {"stroke", chart_ink}});
        svg.text((scale.left + scale.right) / 2, bottom + 33,
                 fitted(label, scale.right - scale.left + between / 2, chart_label_size),
                 {.size = chart_label_size, .anchor = TextAnchor::middle});
    }

    /// Heights of the dots of a row: a few pixels apart, so that each is seen, and within the row.
    double height_of(std::size_t row, std::size_t dot) const {
        constexpr double most_apart = 7, half_a_dot = 4.5;  // [px]
        const auto count = static_cast<double>(plot_.rows[row].dots.size());
        const double apart =
            std::min(most_apart, (row_height - 2 * half_a_dot) / std::max(count - 1, 1.0));
        return middle(row) + apart * (static_cast<double>(dot) - (count - 1) / 2);
    }

    void draw_dots(Svg& svg, std::size_t row) const {
        const auto& dots = plot_.rows[row].dots;
        for (const Scale* scale : {&value_, &beside_}) {
            const auto place = [&](const Dot& dot) {
                return scale->at(scale == &value_ ? shown(dot.value) : dot.beside);
            };
            SvgPath join;
            for (std::size_t k = 0; k < dots.size(); ++k) {
                const double x = place(dots[k]), y = height_of(row, k);
                k == 0 ? join.move(x, y) : join.line(x, y);
                if (scale == &value_) draw_whisker(svg, dots[k], y);
            }
            if (dots.size() > 1)
                svg.add("path", {{"class", "guide"},
                                 {"d", join.text()},
                                 {"fill", "none"},
                                 {"stroke", join_color},
                                 {"stroke-width", 1.6}});
            for (std::size_t k = 0; k < dots.size(); ++k)
                draw_mark(svg, {place(dots[k]), height_of(row, k)}, chart_style(dots[k].series),
                          tip(plot_.rows[row], dots[k]));
        }
    }

    std::string tip(const DotRow& row, const Dot& dot) const {
        const std::string& series = plot_.series[dot.series];
        return fmt::format("{}{}{}: {}, {}", row.name, series.empty() ? "" : ", ", series,
                           number_text(dot.value), number_text(dot.beside));
    }

    void draw_whisker(Svg& svg, const Dot& dot, double y) const {
        if (!dot.low || !dot.high) return;
        add_whisker(svg, value_.at(shown(*dot.low)), value_.at(shown(*dot.high)), y,
                    {"stroke", chart_style(dot.series).color});
    }

    void draw_foot(Svg& svg) const {
        double y = top() + rows() + axis_room;
        svg.open("g", {{"class", "legend"}});
        legend_.draw(svg, {0, y}, width_);
        svg.close();
        y += legend_.height(width_);
        for (const std::string& line : notes_) {
            y += chart_line_height;
            svg.text(0, y - text_drop, line, {.size = chart_text_size, .color = chart_note_color});
        }
    }

    const DotPlot& plot_;
    double width_;
    double name_ = 0;  // [px] of the column of names
    Scale value_, beside_;
    Legend legend_;
    std::vector<std::string> notes_;
};

}  // namespace

std::string dot_plot_svg(std::span<const DotPlot> plots, const std::string& title, double wide,
                         std::size_t columns) {
    std::vector<DotPanel> panels;
    for (const DotPlot& plot : plots) panels.emplace_back(plot, wide);
    columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
    const double whole = static_cast<double>(columns) * (wide + 2 * around);
    std::vector<double> heights((panels.size() + columns - 1) / columns, 0.0);
    for (std::size_t i = 0; i < panels.size(); ++i)
        heights[i / columns] = std::max(heights[i / columns], panels[i].height());
    double height = around + (title.empty() ? 0 : head_room);
    const double begin = height;
    for (const double each : heights) height += each + around;

    Svg svg(whole, height);
    svg.add("rect", {{"width", whole}, {"height", height}, {"fill", "#ffffff"}});
    svg.text(whole / 2, around + head_size, fitted(title, whole - 2 * around, head_size),
             {.size = head_size, .anchor = TextAnchor::middle, .bold = true});
    double y = begin;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        if (i > 0 && i % columns == 0) y += heights[i / columns - 1] + around;
        panels[i].draw(svg, around + static_cast<double>(i % columns) * (wide + 2 * around), y);
    }
    return svg.finish();
}

}  // namespace rovernet
