// SPDX-License-Identifier: MIT
#include "pictures/map/robot_marks.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

constexpr double least_radius = 5;  // [px]
constexpr double beyond = 5;        // [px] that the heading stands out beyond the circle
constexpr Color ink{0x11, 0x11, 0x11};

void draw_circle(Svg& svg, const RobotMark& robot) {
    svg.add("circle", {{"cx", robot.at.x},
                       {"cy", robot.at.y},
                       {"r", robot.radius},
                       {"fill", robot.stands_out ? "#ffa94d"
                                : robot.on()     ? "#ffffff"
                                                 : "#d0d0d0"},
                       {"stroke", robot.rim},
                       {"stroke-width", robot.rim == ink ? 1.6 : 2.4}});
}

void draw_heading(Svg& svg, const RobotMark& robot) {
    const auto [sin, cos] = math::sincos(robot.heading);
    const double length = robot.radius + beyond;
    SvgPath path;
    path.move(robot.at.x, robot.at.y);
    path.line(robot.at.x + length * cos, robot.at.y - length * sin);
    for (const bool outer : {true, false}) {
        svg.add("path", {{"d", path.text()},
                         {"stroke", outer ? Color{0xff, 0xff, 0xff} : ink},
                         {"stroke-width", outer ? 4.2 : 2.0},
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
    if (robot.on()) draw_heading(svg, robot);
    draw_circle(svg, robot);
    if (robot.on()) {
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

LegendItem sample(std::string text, Presence presence, bool stands_out) {
    return {std::move(text), 12, [=](Svg& svg, PicturePoint p) {
                const RobotMark robot{.name = "",
                                      .at = {p.x + 6, p.y},
                                      .radius = least_radius,
                                      .heading = 0,
                                      .presence = presence,
                                      .stands_out = stands_out,
                                      .rim = ink};
                draw_circle(svg, robot);
                if (!robot.on()) draw_cross(svg, robot);
            }};
}

}  // namespace

RobotMarks::RobotMarks(const Network& network, std::size_t storey,
                       const std::vector<NodeId>& standing_out, bool colored, const Plot& plot) {
    const auto stands_out = [&](NodeId node) {
        return std::find(standing_out.begin(), standing_out.end(), node) != standing_out.end();
    };
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const NodeId node{i};
        RobotState robot = network.robot(node);
        marks_.push_back({.name = std::move(robot.name),
                          .at = plot.at(robot.at),
                          .radius = std::max(least_radius, robot.radius.value * plot.scale),
                          .heading = robot.heading.value,
                          .presence = robot.presence,
                          .here = network.scene().storeys().number_at(robot.at.z) == storey,
                          .stands_out = stands_out(node),
                          .rim = colored ? robot_color(node) : ink});
    }
}

void RobotMarks::draw(Svg& svg) const {
    for (const auto& robot : marks_) {
        if (robot.drawn()) draw_robot(svg, robot);
    }
    for (const Name& name : names_) {
        svg.text(name.at.x, name.at.y, name.text,
                 {.size = name_size(), .anchor = name.anchor, .halo = true, .color = ink});
    }
}

double RobotMarks::name_size() const {
    constexpr std::size_t many = 60;  // robots, from which on names are smaller
    return marks_.size() > many ? 9 : 12;
}

void RobotMarks::keep_marks_free(LabelPlaces& places) const {
    for (const auto& robot : marks_) {
        if (!robot.drawn()) continue;
        const double r = robot.radius + robot.ring;
        places.keep_free({robot.at.x - r, robot.at.y - r, robot.at.x + r, robot.at.y + r});
        if (!robot.on()) continue;
        const auto [sin, cos] = math::sincos(robot.heading);
        const double tip = robot.radius + beyond;
        const double x = robot.at.x + tip * cos, y = robot.at.y - tip * sin;
        places.keep_free({x - 2, y - 2, x + 2, y + 2});
    }
}

void RobotMarks::place_names(LabelPlaces& places) {
    constexpr std::size_t longest_name = 24;
    constexpr double line = 1.1, ascent = 0.36;  // [em] height of a box, baseline below its middle
    const double size = name_size();
    keep_marks_free(places);
    for (const auto& robot : marks_) {
        if (!robot.drawn()) continue;
        const std::string text = shortened(robot.name, longest_name);
        const auto box =
            places.place(robot.at, robot.radius + robot.ring, text_width(text, size), line * size);
        homeless_ += !box;
        if (!box) continue;
        const TextAnchor anchor = box->left >= robot.at.x    ? TextAnchor::start
                                  : box->right <= robot.at.x ? TextAnchor::end
                                                             : TextAnchor::middle;
        const double x = anchor == TextAnchor::start ? box->left
                         : anchor == TextAnchor::end ? box->right
                                                     : (box->left + box->right) / 2;
        names_.push_back({text, {x, (box->top + box->bottom) / 2 + ascent * size}, anchor});
    }
}

void RobotMarks::append_to(Legend& legend) const {
    bool some_off = false, some_transmitter = false;
    for (const auto& robot : marks_) {
        if (!robot.drawn()) continue;
        if (robot.stands_out && !std::exchange(some_transmitter, true))
            legend.add(sample("transmitter", robot.presence, true));
        some_off = some_off || robot.presence == Presence::off;
    }
    if (some_off) legend.add(sample("switched off", Presence::off, false));
    if (homeless_ == 0) return;
    legend.add({fmt::format("no room for {} name{}", homeless_, homeless_ == 1 ? "" : "s"), 0,
                [](Svg&, PicturePoint) {}});
}

}  // namespace rovernet
