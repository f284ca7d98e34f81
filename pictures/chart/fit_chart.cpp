// SPDX-License-Identifier: MIT
#include "pictures/chart/fit_chart.hpp"

#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

/// Sizes of the drawing [px], and colours.
struct FitStyle {
    static constexpr double width = 900, margin = 14;
    static constexpr double left = 190, right = 710;           // ends of the scale
    static constexpr double name_end = 178, cost_begin = 736;  // columns beside the scale
    static constexpr double head = 92;                         // title, subtitle and legend
    static constexpr double row = 22, panel_head = 40, panel_foot = 38;
    static constexpr double axis = 26, note = 17, radius = 5.5;
    static constexpr const char *best = "#eef5fb", *join = "#aaaaaa";
    static constexpr Color blue{0x00, 0x72, 0xb2}, quiet{0x66, 0x66, 0x66}, plain{0x22, 0x22, 0x22};
};

void draw_fit_dot(Svg& svg, double x, double y, bool hollow) {
    svg.add("circle", {{"class", hollow ? "as-given" : "fitted"},
                       {"cx", x},
                       {"cy", y},
                       {"r", hollow ? FitStyle::radius - 0.5 : FitStyle::radius},
                       {"fill", hollow ? Color{255, 255, 255} : FitStyle::blue},
                       {"stroke", hollow ? FitStyle::plain : FitStyle::blue},
                       {"stroke-width", 1.6}});
}

/// Number of thousands-separated digits: "30,000".
std::string with_commas(double whole) {
    std::string digits = fmt::format("{:.0f}", whole);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

double one_digit(double value) { return std::stod(fmt::format("{:.0e}", value)); }

class FitDrawing {
  public:
    explicit FitDrawing(const FitChart& chart) : chart_(chart) {
        ChartRange errors;
        errors.include(0);
        for (const FitPanel& panel : chart.panels)
            for (const FitRow& row : panel.rows)
                for (const auto& error : {row.as_given, row.fitted})
                    if (error) errors.include(*error);
        constexpr int most_numbers = 8;
        axis_ = number_axis(errors, false, most_numbers, {.low = 0});
    }

    std::string draw() const {
        Svg svg(FitStyle::width, height());
        svg.add("rect", {{"width", FitStyle::width}, {"height", height()}, {"fill", "#ffffff"}});
        draw_head(svg);
        double y = FitStyle::head;
        for (const FitPanel& panel : chart_.panels) y = draw_panel(svg, panel, y);
        svg.text(
            (FitStyle::left + FitStyle::right) / 2, y + 8, chart_.value_label,
            {.size = chart_label_size, .anchor = TextAnchor::middle, .color = FitStyle::quiet});
        y += FitStyle::axis;
        for (const std::string& note : chart_.notes) {
            svg.text(FitStyle::margin, y + 4, note,
                     {.size = chart_label_size, .color = FitStyle::quiet});
            y += FitStyle::note;
        }
        return svg.finish();
    }

  private:
    double at(double error) const {
        return FitStyle::left + axis_.share(error) * (FitStyle::right - FitStyle::left);
    }

    double height() const {
        double out = FitStyle::head + FitStyle::axis +
                     FitStyle::note * static_cast<double>(chart_.notes.size());
        for (const FitPanel& panel : chart_.panels)
            out += FitStyle::panel_head + FitStyle::panel_foot +
                   FitStyle::row * static_cast<double>(panel.rows.size());
        return out;
    }

    void draw_head(Svg& svg) const {
        svg.text(FitStyle::margin, 28, chart_.title, {.size = 19, .bold = true});
        svg.text(FitStyle::margin, 50, chart_.subtitle,
                 {.size = 13.5, .color = {0x44, 0x44, 0x44}});
        draw_fit_dot(svg, FitStyle::margin + 8, 72, true);
        svg.text(FitStyle::margin + 20, 76, "as given: the default parameters");
        draw_fit_dot(svg, 282, 72, false);
        svg.text(294, 76, "fitted to the place");
        svg.text(FitStyle::cost_begin, 76, "cheapest model first", {.color = FitStyle::quiet});
    }

    double draw_panel(Svg& svg, const FitPanel& panel, double top) const {
        const double begin = top + FitStyle::panel_head;
        const double end = begin + FitStyle::row * static_cast<double>(panel.rows.size());
        svg.text(FitStyle::margin, top + 26, panel.title, {.size = 16, .bold = true});
        svg.text(FitStyle::left, top + 26, "compared with " + panel.reference,
                 {.color = FitStyle::quiet});
        svg.text(FitStyle::cost_begin, top + 26, "cost (reference = 1)",
                 {.color = FitStyle::quiet});
        for (std::size_t i = 0; i < panel.rows.size(); ++i)
            if (panel.rows[i].best)
                svg.add("rect", {{"x", 8.0},
                                 {"y", begin + FitStyle::row * static_cast<double>(i)},
                                 {"width", FitStyle::width - 16},
                                 {"height", FitStyle::row},
                                 {"fill", FitStyle::best}});
        draw_scale(svg, begin, end);
        for (std::size_t i = 0; i < panel.rows.size(); ++i)
            draw_row(svg, panel.rows[i], begin + FitStyle::row * (static_cast<double>(i) + 0.5));
        return end + FitStyle::panel_foot;
    }

    void draw_scale(Svg& svg, double begin, double end) const {
        SvgPath grid, axis_line;
        for (const ChartTick& tick : axis_.ticks) {
            if (tick.text.empty()) continue;
            grid.move(at(tick.value), begin).vertical(end);
            svg.text(
                at(tick.value), end + 16, tick.text,
                {.size = chart_text_size, .anchor = TextAnchor::middle, .color = FitStyle::quiet});
        }
        axis_line.move(FitStyle::left, begin).vertical(end);
        svg.add("path", {{"class", "grid"}, {"d", grid.text()}, {"stroke", chart_grid}});
        svg.add("path", {{"class", "axes"}, {"d", axis_line.text()}, {"stroke", chart_ink}});
    }

    void draw_row(Svg& svg, const FitRow& row, double y) const {
        svg.text(FitStyle::name_end, y + text_drop, row.name,
                 {.size = 13, .anchor = TextAnchor::end, .bold = row.best});
        svg.text(FitStyle::cost_begin, y + text_drop, cost_text(row.cost));
        if (row.as_given && row.fitted) {
            SvgPath join;
            join.move(at(*row.as_given), y).horizontal(at(*row.fitted));
            svg.add("path", {{"class", "guide"},
                             {"d", join.text()},
                             {"stroke", FitStyle::join},
                             {"stroke-width", 2}});
        }
        if (row.as_given) draw_fit_dot(svg, at(*row.as_given), y, true);
        if (row.fitted) draw_fit_dot(svg, at(*row.fitted), y, false);
        if (row.best) draw_number(svg, row, y);
    }

    /// The smaller error beside its dot, on the side without the other dot if there is room.
    void draw_number(Svg& svg, const FitRow& row, double y) const {
        const double error = row.least_error();
        const std::string text = fmt::format("{:.2g}", error);
        const double wide = text_width(text, chart_label_size), gap = FitStyle::radius + 4;
        const bool before = at(error) - gap - wide > FitStyle::left;
        svg.text(before ? at(error) - gap : at(std::max(row.as_given.value_or(0), error)) + gap,
                 y + text_drop, text,
                 {.size = chart_label_size,
                  .anchor = before ? TextAnchor::end : TextAnchor::start,
                  .bold = true,
                  .color = FitStyle::blue});
    }

    const FitChart& chart_;
    ChartAxis axis_;
};

}  // namespace

std::string cost_text(double cost) {
    if (cost < 0.95) return "1/" + with_commas(std::max(one_digit(1 / cost), 2.0));
    if (cost < 1.5) return "the same";
    return with_commas(one_digit(cost)) + " times";
}

std::string fit_chart_svg(const FitChart& chart) { return FitDrawing(chart).draw(); }

}  // namespace rovernet
