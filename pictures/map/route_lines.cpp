// SPDX-License-Identifier: MIT
#include "pictures/map/route_lines.hpp"

#include "pictures/draw/arrow_head.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

constexpr Color up_color{0x00, 0x72, 0xb2}, down_color{0xd5, 0x5e, 0x00};
constexpr double arrow_width = 3.2;                  // [px]
constexpr double arrow_gap = 2;                      // [px] between an arrow and its robot
constexpr double break_width = 6, break_stroke = 3;  // [px] of the ring beyond the circle
constexpr double age_size = 11;                      // [px]

void stroke(Svg& svg, const std::string& data, bool is_up) {
    for (const bool is_seam : {true, false}) {
        svg.add("path", {{"d", data},
                         {"fill", "none"},
                         {"stroke", is_seam ? Color{0xff, 0xff, 0xff}
                                    : is_up ? up_color
                                            : down_color},
                         {"stroke-width", arrow_width + (is_seam ? 2 : 0)},
                         {"stroke-dasharray", is_up || is_seam ? "none" : "8 5"}});
    }
}

/// Arrow whose tip is `back` [px] before `to`.
void draw_arrow(Svg& svg, PicturePoint from, PicturePoint to, double back, bool is_up) {
    SvgPath line, head;
    line.move(from.x, from.y).line(to.x, to.y);
    stroke(svg, line.text(), is_up);
    append_arrow_head(head, from, to, back, arrow_width);
    if (head.empty()) return;
    svg.add("path", {{"d", head.text()},
                     {"fill", is_up ? up_color : down_color},
                     {"stroke", "#ffffff"},
                     {"stroke-width", 1.0},
                     {"paint-order", "stroke"}});
}

/// Ring around the robot at which the way breaks off.
void draw_break(Svg& svg, PicturePoint at, double radius) {
    svg.add("circle", {{"cx", at.x},
                       {"cy", at.y},
                       {"r", radius + break_width},
                       {"fill", "none"},
                       {"stroke", down_color},
                       {"stroke-width", break_stroke}});
}

LegendItem sample(std::string text, bool is_up) {
    return {std::move(text), 34, [is_up](Svg& svg, PicturePoint p) {
                draw_arrow(svg, p, {p.x + 32, p.y}, 0, is_up);
            }};
}

}  // namespace

void RouteLines::keep_off(LabelPlaces& places, RobotMarks& robots) const {
    if (way_.broken_at) robots.add_ring(*way_.broken_at, break_width + break_stroke / 2);
    for (const auto& hop : way_.hops) places.avoid(robots[hop.from].at, robots[hop.to].at);
}

void RouteLines::place_ages(LabelPlaces& places, const RobotMarks& robots) {
    constexpr double line = 1.1, ascent = 0.36;  // [em]
    for (const auto& hop : way_.hops) {
        const RobotMark &from = robots[hop.from], &to = robots[hop.to];
        if (!from.drawn() || !to.drawn()) continue;
        const PicturePoint middle{(from.at.x + to.at.x) / 2, (from.at.y + to.at.y) / 2};
        const std::string text = fmt::format("{:.3g} s", seconds(hop.age));
        const auto box =
            places.place(middle, arrow_width, text_width(text, age_size), line * age_size);
        if (!box) continue;
        ages_.push_back(
            {text,
             {(box->left + box->right) / 2, (box->top + box->bottom) / 2 + ascent * age_size},
             hop.is_up});
    }
}

void RouteLines::draw(Svg& svg, const RobotMarks& robots) const {
    svg.open("g", {{"class", "route"}});
    for (const auto& hop : way_.hops) {
        const RobotMark &from = robots[hop.from], &to = robots[hop.to];
        if (from.drawn() && to.drawn())
            draw_arrow(svg, from.at, to.at, to.radius + arrow_gap, hop.is_up);
    }
    if (way_.broken_at && robots[*way_.broken_at].drawn()) {
        draw_break(svg, robots[*way_.broken_at].at, robots[*way_.broken_at].radius);
    }
    for (const Age& age : ages_) {
        svg.text(age.at.x, age.at.y, age.text,
                 {.size = age_size,
                  .anchor = TextAnchor::middle,
                  .halo = true,
                  .color = age.is_up ? up_color : down_color});
    }
    svg.close();
}

void RouteLines::append_to(Legend& legend) const {
    const auto has = [&](bool is_up) {
        return std::ranges::any_of(way_.hops, [&](const auto& hop) { return hop.is_up == is_up; });
    };
    if (has(true)) legend.add(sample("hop of the route, with the route's age", true));
    if (has(false)) legend.add(sample("hop whose next robot does not hear the sender", false));
    if (!way_.broken_at) return;
    legend.add({"the route breaks off here", 22, [](Svg& svg, PicturePoint p) {
                    draw_break(svg, {p.x + 11, p.y}, 3);
                }});
}

}  // namespace rovernet
