// SPDX-License-Identifier: MIT
#include "pictures/chart/budget_chart.hpp"

#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace rovernet {
namespace {

/// Sizes of the drawing [px].
struct BudgetStyle {
    static constexpr double width = 760, margin = 14;
    static constexpr double left = 220, right = 640;          // ends of the scale
    static constexpr double name_end = 208, value_end = 740;  // columns beside the scale
    static constexpr double head = 66, row = 24, bar = 14, foot = 30;
};

/// Kinds of bars, in the order of their colours: those of the first series of a chart.
enum class Bar { margin, loss, gain };

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
        svg.text(BudgetStyle::margin, 46, chart_.subtitle, {.color = chart_note_color});
        draw_scale(svg);
        draw_row(svg, "power", fmt::format("{:.1f} dBm", chart_.power), true);
        double level = chart_.power;
        for (const BudgetStep& step : chart_.steps) {
            draw_join(svg, level);
            draw_bar(svg, step.change < 0 ? Bar::loss : Bar::gain, level, level + step.change);
            draw_row(svg, step.name, fmt::format("{:+.1f} dB", step.change), false);
            level += step.change;
        }
        draw_join(svg, level);
        draw_row(svg, "received level", fmt::format("{:.1f} dBm", level), true);
        const double margin = level - chart_.sensitivity;
        draw_bar(svg, margin < 0 ? Bar::loss : Bar::margin, chart_.sensitivity, level);
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

    /// Bar of the next row.
    void draw_bar(Svg& svg, Bar bar, double from, double to) const {
        constexpr const char* names[] = {"margin", "loss", "gain"};
        const auto number = static_cast<std::size_t>(bar);
        const double low = at(std::min(from, to)), high = at(std::max(from, to));
        svg.add("rect", {{"class", names[number]},
                         {"x", low},
                         {"y", top_ + 0.5 * (BudgetStyle::row - BudgetStyle::bar)},
                         {"width", std::max(high - low, 1.0)},
                         {"height", BudgetStyle::bar},
                         {"fill", chart_style(number).color}});
    }

    /// Vertical line at a level, from the middle of the row above to the middle of the next row.
    void draw_join(Svg& svg, double level) const {
        SvgPath line;
        line.move(at(level), top_ - 0.5 * BudgetStyle::row).vertical(top_ + 0.5 * BudgetStyle::row);
        svg.add("path", {{"class", "level"}, {"d", line.text()}, {"stroke", chart_ink}});
    }

    void draw_scale(Svg& svg) const {
        SvgPath grid;
        for (const ChartTick& tick : axis_.ticks) {
            if (tick.text.empty()) continue;
            grid.move(at(tick.value), BudgetStyle::head).vertical(end());
            svg.text(
                at(tick.value), end() + 16, tick.text,
                {.size = chart_text_size, .anchor = TextAnchor::middle, .color = chart_note_color});
        }
        svg.add("path", {{"class", "grid"}, {"d", grid.text()}, {"stroke", chart_grid}});
        svg.text(BudgetStyle::right + 12, end() + 16, "dBm",
                 {.size = chart_text_size, .color = chart_note_color});
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
