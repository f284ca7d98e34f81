// SPDX-License-Identifier: MIT
#include "pictures/draw/legend.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr double text_size = 11;   // [px]
constexpr double row_height = 20;  // [px]
constexpr double sign_gap = 6;     // [px] between sign and text
constexpr double item_gap = 20;    // [px] between items
constexpr std::string_view separator = " \xc2\xb7 ";

double item_width(const LegendItem& item) {
    constexpr double bold = 1.15;  // times as wide as other text, at most
    if (!item.draw) return bold * text_width(item.text, text_size);
    return item.width + sign_gap + text_width(item.text, text_size);
}

/// Appends `word` to the last line, or begins another.
void append(std::vector<std::string>& lines, std::string_view between, std::string_view word,
            double width, double size) {
    std::string longer = lines.back();
    if (!longer.empty()) longer += between;
    longer += word;
    if (lines.back().empty() || text_width(longer, size) <= width) {
        lines.back() = std::move(longer);
    } else {
        lines.emplace_back(word);
    }
}

}  // namespace

std::vector<PicturePoint> Legend::places(double width) const {
    std::vector<PicturePoint> out;
    double x = 0, y = 0;
    for (const auto& item : items_) {
        const double own = item_width(item);
        if (x > 0 && x + own > width) {
            x = 0;
            y += row_height;
        }
        out.push_back({x, y});
        x += own + item_gap;
    }
    return out;
}

double Legend::height(double width) const {
    return items_.empty() ? 0 : places(width).back().y + row_height;
}

void Legend::draw(Svg& svg, PicturePoint corner, double width) const {
    constexpr double baseline = 4;  // [px] below the middle of a line
    const auto at = places(width);
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const double x = corner.x + at[i].x, y = corner.y + at[i].y + row_height / 2;
        const bool title = !items_[i].draw;
        if (!title) items_[i].draw(svg, {x, y});
        svg.text(title ? x : x + items_[i].width + sign_gap, y + baseline, items_[i].text,
                 {.size = text_size, .bold = title});
    }
}

LegendItem scale_bar(const Plot& plot) {
    const double length = round_number(plot.width / 6 / plot.scale);
    const double width = std::max(2.0, length * plot.scale);
    return {length_text(length), width, [width](Svg& svg, PicturePoint p) {
                constexpr double end = 4;  // [px] half the height of its ends
                SvgPath path;
                path.move(p.x, p.y - end).vertical(p.y + end);
                path.move(p.x, p.y).horizontal(p.x + width);
                path.move(p.x + width, p.y - end).vertical(p.y + end);
                svg.add("path", {{"d", path.text()},
                                 {"fill", "none"},
                                 {"stroke", "#222222"},
                                 {"stroke-width", 2.0}});
            }};
}

std::vector<std::string> wrapped(const std::vector<std::string>& parts, double width, double size) {
    std::vector<std::string> lines{""};
    for (const auto& part : parts) {
        if (text_width(part, size) <= width) {
            append(lines, separator, part, width, size);
            continue;
        }
        std::string_view between = separator, rest = part;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            append(lines, between, rest.substr(0, end), width, size);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            between = " ";
        }
    }
    return lines;
}

}  // namespace rovernet
