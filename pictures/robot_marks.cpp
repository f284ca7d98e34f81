// SPDX-License-Identifier: MIT
#include "pictures/robot_marks.hpp"

#include "sim/math.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr double least_radius = 5;  // [px]
constexpr double tick = 5;          // [px] that the heading stands out beyond the circle
constexpr const char* ink = "#111111";

void draw_circle(Svg& svg, const RobotMark& robot) {
    svg.add("circle", {{"cx", robot.at.x},
                       {"cy", robot.at.y},
                       {"r", robot.radius},
                       {"fill", robot.stands_out ? "#ffa94d"
                                : robot.on       ? "#ffffff"
                                                 : "#d0d0d0"},
                       {"stroke", ink},
                       {"stroke-width", 1.6}});
}

void draw_heading(Svg& svg, const RobotMark& robot) {
    const auto [sin, cos] = math::sincos(robot.heading);
    const double length = robot.radius + tick;
    SvgPath path;
    path.move(robot.at.x, robot.at.y);
    path.line(robot.at.x + length * cos, robot.at.y - length * sin);
    for (const bool seam : {true, false}) {
        svg.add("path", {{"d", path.text()},
                         {"stroke", seam ? "#ffffff" : ink},
                         {"stroke-width", seam ? 4.2 : 2.0},
                         {"stroke-linecap", "round"}});
    }
}

/// A robot that is switched off points nowhere: it is crossed out.
void draw_cross(Svg& svg, const RobotMark& robot) {
    constexpr double half = 0.6;  // of the radius
    const double r = half * robot.radius, x = robot.at.x, y = robot.at.y;
    SvgPath path;
    path.move(x - r, y - r).line(x + r, y + r).move(x - r, y + r).line(x + r, y - r);
    svg.add("path", {{"d", path.text()}, {"stroke", ink}, {"stroke-width", 1.4}});
}

void draw_robot(Svg& svg, const RobotMark& robot) {
    svg.open("g", {});
    svg.title(robot.name);
    if (robot.on) draw_heading(svg, robot);
    draw_circle(svg, robot);
    if (robot.on) {
        const auto [sin, cos] = math::sincos(robot.heading);
        SvgPath path;
        path.move(robot.at.x, robot.at.y);
        path.line(robot.at.x + robot.radius * cos, robot.at.y - robot.radius * sin);
        svg.add("path", {{"d", path.text()}, {"stroke", ink}, {"stroke-width", 2.0}});
    } else {
        draw_cross(svg, robot);
    }
    svg.close();
}

LegendItem sample(std::string text, bool on, bool stands_out) {
    return {std::move(text), 12, [on, stands_out](Svg& svg, PicturePoint p) {
                const RobotMark robot{.name = "",
                                      .at = {p.x + 6, p.y},
                                      .radius = least_radius,
                                      .heading = 0,
                                      .on = on,
                                      .stands_out = stands_out};
                draw_circle(svg, robot);
                if (!on) draw_cross(svg, robot);
            }};
}

}  // namespace

RobotMarks::RobotMarks(const Network& network, const std::vector<Meters>& radii,
                       std::optional<NodeId> standing_out, Time at, const Plot& plot) {
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const NodeId node{i};
        marks_.push_back({.name = network.name(node),
                          .at = plot.at(network.legs().position(node, at)),
                          .radius = std::max(least_radius, radii[i].value * plot.scale),
                          .heading = network.legs().leg(node).heading_at(at),
                          .on = network.medium().is_on(node),
                          .stands_out = standing_out == node});
    }
}

void RobotMarks::draw(Svg& svg, LabelPlaces& places) const {
    for (const auto& robot : marks_) draw_robot(svg, robot);
    draw_names(svg, places);
}

void RobotMarks::draw_names(Svg& svg, LabelPlaces& places) const {
    constexpr std::size_t longest_name = 24;
    constexpr std::size_t many = 60;             // robots, from which on names are smaller
    constexpr double line = 1.1, ascent = 0.36;  // [em] height of a box, baseline below its middle
    const double size = marks_.size() > many ? 9 : 12;
    for (const auto& robot : marks_) {
        const double r = robot.radius;
        places.keep_free({robot.at.x - r, robot.at.y - r, robot.at.x + r, robot.at.y + r});
        if (!robot.on) continue;
        const auto [sin, cos] = math::sincos(robot.heading);
        const double x = robot.at.x + (r + tick) * cos, y = robot.at.y - (r + tick) * sin;
        places.keep_free({x - 2, y - 2, x + 2, y + 2});
    }
    for (const auto& robot : marks_) {
        const std::string name = shortened(robot.name, longest_name);
        const double width = text_width(name, size);
        const auto box = places.place(robot.at, robot.radius, width, line * size);
        if (!box) continue;
        const TextAnchor anchor = box->left >= robot.at.x    ? TextAnchor::start
                                  : box->right <= robot.at.x ? TextAnchor::end
                                                             : TextAnchor::middle;
        const double x = anchor == TextAnchor::start ? box->left
                         : anchor == TextAnchor::end ? box->right
                                                     : (box->left + box->right) / 2;
        svg.text(x, (box->top + box->bottom) / 2 + ascent * size, name,
                 {.size = size, .anchor = anchor, .halo = true, .color = {0x11, 0x11, 0x11}});
    }
}

void RobotMarks::append_to(Legend& legend) const {
    for (const auto& robot : marks_) {
        if (robot.stands_out) legend.add(sample("transmitter", robot.on, true));
    }
    const bool some_off =
        std::any_of(marks_.begin(), marks_.end(), [](const RobotMark& r) { return !r.on; });
    if (some_off) legend.add(sample("switched off", false, false));
}

}  // namespace rovernet
