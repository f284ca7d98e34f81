// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_panel.hpp"

#include "pictures/chart/chart_heat_map.hpp"
#include "pictures/chart/chart_legend.hpp"
#include "pictures/chart/chart_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

constexpr double title_line = 19;                         // [px]
constexpr double tick_length = 4;                         // [px]
constexpr double label_room = 20;                         // [px] of the label of an axis
constexpr double slope_sin = 0.6428, slope_cos = 0.7660;  // of texts that rise by 40 degrees
constexpr double most_slanted = 130;                      // [px] of their length

double widest(const ChartAxis& axis) {
    double out = 0;
    for (const auto& tick : axis.ticks) out = std::max(out, text_width(tick.text, chart_text_size));
    return out;
}

/// Whether the labels of an axis of this length fit side by side.
bool side_by_side(const ChartAxis& axis, double length) {
    constexpr double gap = 10;  // [px]
    double end = -length;
    for (const auto& tick : axis.ticks) {
        if (tick.text.empty()) continue;
        const double middle = axis.share(tick.value) * length;
        const double half = text_width(tick.text, chart_text_size) / 2;
        if (middle - half < end + gap) return false;
        end = middle + half;
    }
    return true;
}

/// Numeric axis with the largest number of labels that fit side by side.
ChartAxis widest_axis(const ChartRange& range, bool log, double length, const ChartLimits& limits) {
    constexpr int most = 11, fewest = 3;
    for (int texts = most; texts > fewest; --texts) {
        ChartAxis axis = number_axis(range, log, texts, limits);
        if (side_by_side(axis, length)) return axis;
    }
    return number_axis(range, log, fewest, limits);
}

/// Stride of the words of an axis that have room for their texts. @param least  [px] from text to
/// text
std::size_t stride(const ChartAxis& axis, double length, double least) {
    if (axis.ticks.empty()) return 1;
    const double room = length / static_cast<double>(axis.ticks.size());
    return static_cast<std::size_t>(std::max(1.0, std::ceil(least / room)));
}

std::vector<std::string> names_of(const Chart& chart) {
    std::vector<std::string> out;
    for (const auto& series : chart.series) out.push_back(series.name);
    return out;
}

/// Lines of whole words, the last one and what is too long cut off.
std::vector<std::string> lines_of(const std::vector<std::string>& parts, double width, double size,
                                  std::size_t most) {
    if (parts.empty() || (parts.size() == 1 && parts[0].empty())) return {};
    std::vector<std::string> lines = wrapped(parts, width, size);
    if (lines.size() > most) {
        lines.resize(most);
        lines.back() += " \xe2\x80\xa6";
    }
    for (auto& line : lines) line = fitted(line, width, size);
    return lines;
}

std::string rotation(double degrees, double x, double y) {
    return fmt::format("rotate({} {} {})", svg_number(degrees), svg_number(x), svg_number(y));
}

}  // namespace

std::string fitted(std::string_view text, double width, double size) {
    constexpr std::size_t longest = 400;
    if (text_width(text, size) <= width) return std::string(text);
    std::size_t most = std::min(text.size(), longest);
    std::string out = shortened(text, most);
    while (most > 1 && text_width(out, size) > width) out = shortened(text, --most);
    return out;
}

ChartPanel::ChartPanel(const Chart& chart, const ChartLayout& layout, std::size_t number)
    : chart_(chart), width_(layout.width), number_(number), view_(view_of(chart)) {
    constexpr std::size_t title_lines = 3, note_lines = 12;
    place_axes(layout.height);
    title_ = lines_of({chart.title}, width_, chart_title_size, title_lines);
    notes_ = lines_of(notes(), width_, chart_text_size, note_lines);
    legend_ = chart_legend(chart, view_, room_for_marks(view_, frame_), width_);
}

void ChartPanel::place_axes(double height) {
    constexpr double inset = 10, margin = 22;  // [px]
    constexpr double tick_spacing = 36;        // [px] of the y axis
    const int ticks = static_cast<int>(std::clamp(height / tick_spacing, 3.0, 11.0));
    frame_.box = {0, 0, width_ - (heat_map() ? color_bar_width : margin), height};
    frame_.inset = view_.has_words ? 0 : inset;
    frame_.rise = rise_of_marks(chart_, view_);
    const ChartLimits& limits = view_.y_limits;
    colors_ = number_axis(view_.y_range, false, ticks, limits);
    frame_.y = heat_map() ? word_axis(names_of(chart_))
                          : number_axis(view_.y_range, chart_.log_y, ticks, limits);
    place_left();
    if (view_.has_words) {
        frame_.x = word_axis(view_.words);
    } else {
        place_numbers();
        // Series with an offset need a larger margin; the offset does not grow in the remaining
        // space.
        frame_.inset = std::max(inset, reach_of_marks(chart_, view_, frame_));
        place_numbers();
    }
    place_below();
}

void ChartPanel::place_numbers() {
    const double length = frame_.box.right - frame_.box.left - 2 * frame_.inset;
    frame_.x = widest_axis(view_.x_range, chart_.log_x, length, chart_.x_limits);
}

std::vector<std::string> ChartPanel::notes() const {
    std::vector<std::string> out = view_.notes;
    if (chart_.kind != ChartKind::scatter) return out;
    Svg nowhere(1, 1);
    const std::size_t homeless = draw_scatter(nowhere, chart_, view_, frame_);
    if (homeless > 0) {
        out.push_back(fmt::format("no room for {} label{}", homeless, homeless == 1 ? "" : "s"));
    }
    return out;
}

void ChartPanel::place_left() {
    constexpr double gap = 4, most_words = 0.3;  // [px]; of the width, for words
    const double label = chart_.y_label.empty() ? 0 : label_room;
    const double texts = view_.points > 0 ? widest(frame_.y) : 0;
    frame_.box.left = label + tick_length + gap + std::min(texts, most_words * width_);
}

void ChartPanel::place_below() {
    constexpr double gap = 6;  // [px]
    const double length = frame_.box.right - frame_.box.left;
    slanted_ = view_.has_words && !side_by_side(frame_.x, length);
    const double longest = std::min(widest(frame_.x), most_slanted);
    texts_below_ =
        tick_length + gap + (slanted_ ? slope_sin * longest + chart_text_size : chart_text_size);
}

std::size_t ChartPanel::stride_below() const {
    constexpr double least = chart_line_height / slope_sin;  // [px]
    return slanted_ ? stride(frame_.x, frame_.box.right - frame_.box.left, least) : 1;
}

double ChartPanel::head() const {
    constexpr double gap = 10;  // [px]
    return static_cast<double>(title_.size()) * title_line +
           (heat_map() && !chart_.value_label.empty() ? label_room : 0) + gap;
}

double ChartPanel::foot() const {
    constexpr double gap = 6;  // [px]
    return texts_below_ + (chart_.x_label.empty() ? 0 : label_room) + legend_.height(width_) +
           static_cast<double>(notes_.size()) * chart_line_height + gap;
}

void ChartPanel::draw(Svg& svg, PicturePoint corner, double head_of_row) const {
    svg.open("g", {{"class", "panel"},
                   {"transform",
                    fmt::format("translate({} {})", svg_number(corner.x), svg_number(corner.y))}});
    double y = chart_title_size - head_of_row;
    for (const auto& line : title_) {
        svg.text(width_ / 2, y, line,
                 {.size = chart_title_size, .anchor = TextAnchor::middle, .bold = true});
        y += title_line;
    }
    if (view_.points == 0) {
        const double middle = (frame_.box.left + frame_.box.right) / 2;
        svg.text(
            middle, frame_.box.bottom / 2, "no results",
            {.size = chart_title_size, .anchor = TextAnchor::middle, .color = chart_note_color});
    }
    draw_axes(svg);
    draw_points(svg);
    draw_labels(svg);
    draw_foot(svg);
    svg.close();
}

void ChartPanel::draw_points(Svg& svg) const {
    switch (chart_.kind) {
        case ChartKind::lines: draw_lines(svg, chart_, view_, frame_); break;
        case ChartKind::bars: draw_bars(svg, chart_, view_, frame_); break;
        case ChartKind::scatter: draw_scatter(svg, chart_, view_, frame_); break;
        case ChartKind::cdf: draw_cdf(svg, view_, frame_); break;
        case ChartKind::heat_map: draw_cells(svg, view_, frame_, colors_); break;
    }
}

void ChartPanel::append_ticks(SvgPath& lines, SvgPath& ticks) const {
    const Box& box = frame_.box;
    for (const auto& tick : frame_.y.ticks) {
        if (heat_map()) break;
        const double y = frame_.at(frame_.x.low, tick.value).y;
        if (!tick.text.empty()) lines.move(box.left, y).horizontal(box.right);
        ticks.move(box.left - tick_length, y).horizontal(box.left);
    }
    const std::size_t every = stride_below();
    for (std::size_t i = 0; i < frame_.x.ticks.size(); i += every) {
        const ChartTick& tick = frame_.x.ticks[i];
        const double x = frame_.at(tick.value, frame_.y.low).x;
        if (!view_.has_words && !tick.text.empty()) lines.move(x, box.top).vertical(box.bottom);
        ticks.move(x, box.bottom).vertical(box.bottom + tick_length);
    }
}

void ChartPanel::draw_axes(Svg& svg) const {
    const Box& box = frame_.box;
    SvgPath lines, axes;
    if (view_.points > 0) append_ticks(lines, axes);
    const double zero = frame_.at(frame_.x.low, 0).y;
    const bool has_zero = !frame_.y.log && frame_.y.low <= 0 && frame_.y.high >= 0;
    axes.move(box.left, box.top).vertical(box.bottom).horizontal(box.right);
    if (!heat_map() && has_zero && zero < box.bottom && zero > box.top) {
        axes.move(box.left, zero).horizontal(box.right);
    }
    svg.add("path", {{"class", "grid"}, {"d", lines.text()}, {"stroke", chart_grid}});
    svg.add("path",
            {{"class", "axes"}, {"d", axes.text()}, {"fill", "none"}, {"stroke", chart_ink}});
    if (view_.points == 0) return;
    draw_texts_beside(svg);
    draw_texts_below(svg);
}

void ChartPanel::draw_texts_beside(Svg& svg) const {
    const Box& box = frame_.box;
    const double room = box.left - tick_length - (chart_.y_label.empty() ? 0 : label_room);
    const auto& ticks = frame_.y.ticks;
    const std::size_t every =
        heat_map() ? stride(frame_.y, box.bottom - box.top, chart_line_height) : 1;
    svg.open("g", {{"class", "y-texts"}});
    for (std::size_t i = 0; i < ticks.size(); i += every) {
        const double y = frame_.at(frame_.x.low, ticks[i].value).y;
        if (ticks[i].text.empty()) continue;
        svg.text(box.left - tick_length - 3, y + text_drop,
                 fitted(ticks[i].text, room, chart_text_size),
                 {.size = chart_text_size, .anchor = TextAnchor::end});
    }
    svg.close();
}

void ChartPanel::draw_texts_below(Svg& svg) const {
    constexpr double slope = -40;  // [degrees]
    const auto& ticks = frame_.x.ticks;
    const std::size_t every = stride_below();
    const double y = frame_.box.bottom + tick_length + chart_text_size;
    svg.open("g", {{"class", "x-texts"}});
    for (std::size_t i = 0; i < ticks.size(); i += every) {
        const double x = frame_.at(ticks[i].value, frame_.y.low).x;
        if (ticks[i].text.empty()) continue;
        if (slanted_) {
            const double room = std::min(most_slanted, x / slope_cos);
            svg.open("g", {{"transform", rotation(slope, x + text_drop, y)}});
            svg.text(x + text_drop, y, fitted(ticks[i].text, room, chart_text_size),
                     {.size = chart_text_size, .anchor = TextAnchor::end});
            svg.close();
        } else {
            svg.text(x, y + 2, ticks[i].text,
                     {.size = chart_text_size, .anchor = TextAnchor::middle});
        }
    }
    svg.close();
}

void ChartPanel::draw_labels(Svg& svg) const {
    const Box& box = frame_.box;
    const double middle = (box.top + box.bottom) / 2;
    if (!chart_.y_label.empty()) {
        svg.open("g", {{"transform", rotation(-90, chart_label_size, middle)}});
        svg.text(chart_label_size, middle,
                 fitted(chart_.y_label, box.bottom - box.top, chart_label_size),
                 {.size = chart_label_size, .anchor = TextAnchor::middle});
        svg.close();
    }
    if (heat_map() && view_.points > 0) {
        draw_color_bar(svg, frame_, colors_, number_);
        svg.text(width_, box.top - label_room / 2,
                 fitted(chart_.value_label, width_, chart_text_size),
                 {.size = chart_text_size, .anchor = TextAnchor::end});
    }
}

void ChartPanel::draw_foot(Svg& svg) const {
    const Box& box = frame_.box;
    double y = box.bottom + texts_below_;
    if (!chart_.x_label.empty()) {
        y += label_room;
        svg.text((box.left + box.right) / 2, y - 5,
                 fitted(chart_.x_label, box.right - box.left, chart_label_size),
                 {.size = chart_label_size, .anchor = TextAnchor::middle});
    }
    svg.open("g", {{"class", "legend"}});
    legend_.draw(svg, {0, y}, width_);
    svg.close();
    y += legend_.height(width_);
    for (const auto& line : notes_) {
        y += chart_line_height;
        svg.text(0, y - text_drop, line, {.size = chart_text_size, .color = chart_note_color});
    }
}

}  // namespace rovernet
