// SPDX-License-Identifier: MIT
#include "pictures/map/trail_lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace rovernet {
namespace {

constexpr Color sample_color{0x44, 0x44, 0x44};
constexpr double line_width = 1.4;  // [px]
constexpr double dot_radius = 2.6;  // [px]
constexpr double ring_radius = 3;   // [px]
constexpr double visible = 0.3;     // [px] a corner nearer to the last one is left out

/// About a dozen dots in all, at round times; every 10 s if that is less.
Duration dot_period(Time at) {
    constexpr std::int64_t most_dots = 12;
    Duration period = std::chrono::seconds(10);
    for (std::int64_t factor : {2, 3, 6, 12, 30, 60, 180, 360, 1080, 2160, 8640}) {
        if (at.time_since_epoch() / most_dots <= period) return period;
        period = factor * std::chrono::seconds(10);
    }
    while (at.time_since_epoch() / most_dots > period) period *= 10;
    return period;
}

std::string period_text(Duration period) {
    const double s = seconds(period);
    if (s >= 86400) return fmt::format("{:.6g} d", s / 86400);
    if (s >= 3600) return fmt::format("{:.6g} h", s / 3600);
    if (s >= 60) return fmt::format("{:.6g} min", s / 60);
    return fmt::format("{:.6g} s", s);
}

void append_disc(SvgPath& path, PicturePoint p, double radius) {
    // A diamond would do for the eye; eight corners look round at this size.
    const double d = radius * 0.7071;
    path.move(p.x + radius, p.y).line(p.x + d, p.y + d).line(p.x, p.y + radius);
    path.line(p.x - d, p.y + d).line(p.x - radius, p.y).line(p.x - d, p.y - d);
    path.line(p.x, p.y - radius).line(p.x + d, p.y - d).close();
}

/// Appends a path, without corners that are too close to be visible.
void append_way(SvgPath& path, const std::vector<PicturePoint>& way) {
    PicturePoint last = way.front();
    path.move(last.x, last.y);
    for (std::size_t i = 1; i < way.size(); ++i) {
        const bool seen = std::abs(way[i].x - last.x) + std::abs(way[i].y - last.y) >= visible;
        if (!seen && i + 1 < way.size()) continue;
        last = way[i];
        path.line(last.x, last.y);
    }
}

void draw_way(Svg& svg, const std::string& lines, Color color, double width) {
    svg.add("path", {{"d", lines},
                     {"fill", "none"},
                     {"stroke", color},
                     {"stroke-width", width},
                     {"stroke-linejoin", "round"}});
}

}  // namespace

TrailLines::TrailLines(const Trails& trails, const Network& network, Time at, std::size_t storey)
    : trails_(trails),
      network_(network),
      robots_(static_cast<std::uint32_t>(network.size())),
      storey_(storey),
      at_(at),
      every_(dot_period(at)) {}

bool TrailLines::is_here(Vec3 p) const {
    return network_.scene().storeys().number_at(p.z) == storey_;
}

/// Ways of a robot, without the parts from and to other storeys.
std::vector<std::vector<Vec3>> TrailLines::ways(NodeId node) const {
    std::vector<std::vector<Vec3>> parts;
    for (const auto& way : trails_.ways(node, at_)) {
        bool goes_on = false;
        for (std::size_t i = 1; i < way.size(); ++i) {
            const bool shown = is_here(way[i - 1]) || is_here(way[i]);
            if (shown && !goes_on) parts.push_back({way[i - 1]});
            if (shown) parts.back().push_back(way[i]);
            goes_on = shown;
        }
    }
    return parts;
}

void TrailLines::include_in(Extent& extent) const {
    for (std::uint32_t i = 0; i < robots_; ++i) {
        for (const auto& way : ways(NodeId{i})) {
            for (const Vec3 p : way) extent.include(p);
        }
    }
}

TrailLines::Trail TrailLines::trail(NodeId node, const Plot& plot) const {
    SvgPath lines, dots, rings;
    for (const auto& way : ways(node)) {
        std::vector<PicturePoint> points;
        for (const Vec3 p : way) points.push_back(plot.at(p));
        append_way(lines, points);
        append_disc(rings, points.front(), ring_radius);
    }
    if (lines.empty()) return {};
    for (const Vec3 p : trails_.marks(node, at_, every_)) {
        if (is_here(p)) append_disc(dots, plot.at(p), dot_radius);
    }
    return {lines.text(), dots.text(), rings.text()};
}

void TrailLines::draw(Svg& svg, const Plot& plot, bool on_colors) const {
    std::vector<Trail> all;
    for (std::uint32_t i = 0; i < robots_; ++i) all.push_back(trail(NodeId{i}, plot));
    for (const Trail& each : all) {
        if (!on_colors || each.lines.empty()) continue;
        draw_way(svg, each.lines, {0xff, 0xff, 0xff}, line_width + 2);
    }
    for (std::uint32_t i = 0; i < robots_; ++i) {
        if (all[i].lines.empty()) continue;
        const Color color = robot_color(NodeId{i});
        svg.open("g", {{"class", "trail"}});
        svg.title(network_.name(NodeId{i}));
        draw_way(svg, all[i].lines, color, line_width);
        svg.add("path", {{"d", all[i].dots}, {"fill", color}});
        svg.add("path", {{"d", all[i].rings},
                         {"fill", "#ffffff"},
                         {"stroke", color},
                         {"stroke-width", line_width}});
        svg.close();
    }
}

void TrailLines::append_to(Legend& legend) const {
    legend.add(
        {fmt::format("trail in the robot's colour, a dot every {}", period_text(every_)), 34,
         [](Svg& svg, PicturePoint p) {
             SvgPath line, dot, ring;
             line.move(p.x + ring_radius, p.y).horizontal(p.x + 34);
             append_disc(dot, {p.x + 20, p.y}, dot_radius);
             append_disc(ring, {p.x + ring_radius, p.y}, ring_radius);
             svg.add("path",
                     {{"d", line.text()}, {"stroke", sample_color}, {"stroke-width", line_width}});
             svg.add("path", {{"d", dot.text()}, {"fill", sample_color}});
             svg.add("path", {{"d", ring.text()},
                              {"fill", "#ffffff"},
                              {"stroke", sample_color},
                              {"stroke-width", line_width}});
         }});
}

}  // namespace rovernet
