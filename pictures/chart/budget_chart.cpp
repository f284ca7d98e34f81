// SPDX-License-Identifier: MIT
#include "pictures/chart/budget_chart.hpp"

#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

/// Sizes of the drawing [px], and colours.
struct BudgetStyle {
    static constexpr double width = 760, margin = 14;
    static constexpr double left = 220, right = 640;          // ends of the scale
    static constexpr double name_end = 208, value_end = 740;  // columns beside the scale
    static constexpr double head = 66, row = 24, bar = 14, foot = 30;
    static constexpr Color gain{0x00, 0x9e, 0x73}, loss{0xd5, 0x5e, 0x00}, level{0x00, 0x72, 0xb2};
    static constexpr Color quiet{0x66, 0x66, 0x66};
};

class BudgetDrawing {
  public:
    explicit BudgetDrawing(const BudgetChart& chart) : chart_(chart) {
        ChartRange levels;
        double level = chart.power;
        levels.include(level);
        levels.include(chart.sensitivity);
        for (const BudgetStep& step : chart.steps) levels.include(level += step.change);
        constexpr int most_numbers = 8;
        axis_ = number_axis(levels, false, most_numbers, {});
    }

    std::string draw() {
        Svg svg(BudgetStyle::width, end() + BudgetStyle::foot);
        svg.add("rect", {{"width", BudgetStyle::width},
                         {"height", end() + BudgetStyle::foot},
                         {"fill", "#ffffff"}});
        svg.text(BudgetStyle::margin, 26, chart_.title, {.size = 16, .bold = true});
        svg.text(BudgetStyle::margin, 46, chart_.subtitle, {.color = BudgetStyle::quiet});
        draw_scale(svg);
        draw_row(svg, "power", fmt::format("{:.1f} dBm", chart_.power), true);
        double level = chart_.power;
        for (const BudgetStep& step : chart_.steps) {
            const double after = level + step.change;
            const Color color = step.change < 0 ? BudgetStyle::loss : BudgetStyle::gain;
            draw_bar(svg, step.change < 0 ? "loss" : "gain", level, after, color);
            draw_row(svg, step.name, fmt::format("{:+.1f} dB", step.change), false);
            level = after;
        }
        draw_join(svg, level, BudgetStyle::row);
        draw_row(svg, "received level", fmt::format("{:.1f} dBm", level), true);
        const double margin = level - chart_.sensitivity;
        draw_bar(svg, "margin", chart_.sensitivity, level,
                 margin < 0 ? BudgetStyle::loss : BudgetStyle::level);
        draw_row(svg, margin < 0 ? "missing" : "margin", fmt::format("{:+.1f} dB", margin), true);
        draw_sensitivity(svg);
        return svg.finish();
    }

  private:
    double at(double level) const {
        return BudgetStyle::left + axis_.share(level) * (BudgetStyle::right - BudgetStyle::left);
    }
    double end() const {
        constexpr double levels = 3;  // power, received level and margin
        return BudgetStyle::head +
               BudgetStyle::row * (static_cast<double>(chart_.steps.size()) + levels);
    }

    /// Name and value of the next row.
    void draw_row(Svg& svg, const std::string& name, const std::string& value, bool bold) {
        const double y = top_ + 0.5 * BudgetStyle::row + text_drop;
        constexpr std::size_t most_letters = 34;
        svg.text(BudgetStyle::name_end, y, shortened(name, most_letters),
                 {.anchor = TextAnchor::end, .bold = bold});
        svg.text(BudgetStyle::value_end, y, value, {.anchor = TextAnchor::end, .bold = bold});
        top_ += BudgetStyle::row;
    }

    /// Bar of the next row, and the line down to it from the row above.
    void draw_bar(Svg& svg, const char* what, double from, double to, Color color) const {
        if (what != std::string("margin")) draw_join(svg, from, BudgetStyle::row);
        const double low = at(std::min(from, to)), high = at(std::max(from, to));
        svg.add("rect", {{"class", what},
                         {"x", low},
                         {"y", top_ + 0.5 * (BudgetStyle::row - BudgetStyle::bar)},
                         {"width", std::max(high - low, 1.0)},
                         {"height", BudgetStyle::bar},
                         {"fill", color}});
    }

    /// Vertical line at a level, from the middle of the row above on.
    void draw_join(Svg& svg, double level, double length) const {
        SvgPath line;
        line.move(at(level), top_ - 0.5 * BudgetStyle::row)
            .vertical(top_ - 0.5 * BudgetStyle::row + length);
        svg.add("path", {{"class", "level"}, {"d", line.text()}, {"stroke", chart_ink}});
    }

    void draw_scale(Svg& svg) const {
        SvgPath grid;
        for (const ChartTick& tick : axis_.ticks) {
            if (tick.text.empty()) continue;
            grid.move(at(tick.value), BudgetStyle::head).vertical(end());
            svg.text(at(tick.value), end() + 16, tick.text,
                     {.size = chart_text_size,
                      .anchor = TextAnchor::middle,
                      .color = BudgetStyle::quiet});
        }
        svg.add("path", {{"class", "grid"}, {"d", grid.text()}, {"stroke", chart_grid}});
        svg.text(BudgetStyle::right + 12, end() + 16, "dBm",
                 {.size = chart_text_size, .color = BudgetStyle::quiet});
    }

    /// Dashed line at the sensitivity, with its text in the row of the power.
    void draw_sensitivity(Svg& svg) const {
        const double x = at(chart_.sensitivity);
        SvgPath line;
        line.move(x, BudgetStyle::head).vertical(end());
        svg.add("path", {{"class", "sensitivity"},
                         {"d", line.text()},
                         {"stroke", chart_ink},
                         {"stroke-dasharray", "5 4"}});
        const bool in_left_half = x < 0.5 * (BudgetStyle::left + BudgetStyle::right);
        constexpr double gap = 6;
        svg.text(in_left_half ? x + gap : x - gap,
                 BudgetStyle::head + 0.5 * BudgetStyle::row + text_drop,
                 fmt::format("sensitivity {:.1f} dBm", chart_.sensitivity),
                 {.anchor = in_left_half ? TextAnchor::start : TextAnchor::end});
    }

    const BudgetChart& chart_;
    ChartAxis axis_;
    double top_ = BudgetStyle::head;  // of the next row [px]
};

}  // namespace

std::string budget_chart_svg(const BudgetChart& chart) { return BudgetDrawing(chart).draw(); }

}  // namespace rovernet
