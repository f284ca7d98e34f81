// SPDX-License-Identifier: MIT
#include "pictures/map/trail_lines.hpp"

#include "pictures/map/link_stroke.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace rovernet {
namespace {

constexpr Color sample_color{0x44, 0x44, 0x44};
constexpr double line_width = 1.4;       // [px]
constexpr double graded_width = 1.6;     // [-] of trails by margin, in the width of links
constexpr double dot_radius = 2.6;       // [px]
constexpr double graded_dot_radius = 4;  // [px] on the wider lines of trails by margin
constexpr double ring_radius = 3;        // [px]
constexpr double visible = 0.3;          // [px] a corner nearer to the last one is left out

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

/// White line around dots, which keeps them apart from the line below them.
void draw_seam(Svg& svg, const std::string& dots) {
    svg.add("path", {{"d", dots}, {"stroke", "#ffffff"}, {"stroke-width", 2.4}});
}

void draw_way(Svg& svg, const std::string& lines, Color color, double width) {
    svg.add("path", {{"d", lines},
                     {"fill", "none"},
                     {"stroke", color},
                     {"stroke-width", width},
                     {"stroke-linejoin", "round"}});
}

}  // namespace

TrailLines::TrailLines(const Trails& trails, const Network& network, Time at, std::size_t storey,
                       const MarginSurvey* survey)
    : trails_(trails),
      network_(network),
      robots_(static_cast<std::uint32_t>(network.size())),
      storey_(storey),
      at_(at),
      survey_(survey),
      every_(dot_period(at)) {}

bool TrailLines::is_here(Vec3 p) const {
    return network_.scene().storeys().number_at(p.z) == storey_;
}

/// Ways of a robot from `begin` to `end`, without the parts from and to other storeys.
std::vector<std::vector<Vec3>> TrailLines::ways(NodeId node, Time begin, Time end) const {
    std::vector<std::vector<Vec3>> parts;
    for (const auto& way : trails_.ways(node, begin, end)) {
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
        if (is_here(p))
            append_disc(dots, plot.at(p), has_grades(node) ? graded_dot_radius : dot_radius);
    }
    return {lines.text(), dots.text(), rings.text()};
}

void TrailLines::draw(Svg& svg, const Plot& plot, bool on_colors) const {
    std::vector<Trail> all;
    for (std::uint32_t i = 0; i < robots_; ++i) all.push_back(trail(NodeId{i}, plot));
    for (std::uint32_t i = 0; i < robots_; ++i) {
        if (!on_colors || all[i].lines.empty() || has_grades(NodeId{i})) continue;
        draw_way(svg, all[i].lines, {0xff, 0xff, 0xff}, line_width + 2);
    }
    if (survey_) draw_grades(svg, plot, on_colors);
    for (std::uint32_t i = 0; i < robots_; ++i) {
        if (all[i].lines.empty()) continue;
        const Color color = robot_color(NodeId{i});
        svg.open("g", {{"class", "trail"}});
        svg.title(network_.name(NodeId{i}));
        if (!has_grades(NodeId{i})) draw_way(svg, all[i].lines, color, line_width);
        if (has_grades(NodeId{i})) draw_seam(svg, all[i].dots);
        svg.add("path", {{"d", all[i].dots}, {"fill", color}});
        svg.add("path", {{"d", all[i].rings},
                         {"fill", "#ffffff"},
                         {"stroke", color},
                         {"stroke-width", line_width}});
        svg.close();
    }
}

void TrailLines::draw_grades(Svg& svg, const Plot& plot, bool on_colors) const {
    const auto paths = graded(plot);
    svg.open("g", {{"class", "margins"}});
    for (std::size_t i = 0; i < link_grades.size(); ++i) {
        if (paths[i].empty()) continue;
        if (on_colors)
            draw_link_stroke(svg, paths[i].text(),
                             {.grade = i, .seam = true, .width = graded_width});
        draw_link_stroke(svg, paths[i].text(), {.grade = i, .width = graded_width});
    }
    if (!paths.back().empty()) draw_gap_stroke(svg, paths.back().text());
    svg.close();
}

std::array<SvgPath, link_grades.size() + 1> TrailLines::graded(const Plot& plot) const {
    std::array<SvgPath, link_grades.size() + 1> paths;
    for (std::uint32_t i = 0; i < robots_; ++i) {
        if (!has_grades(NodeId{i})) continue;
        for (const MarginPiece& piece : survey_->pieces(NodeId{i})) {
            for (const auto& way : ways(NodeId{i}, piece.begin, piece.end)) {
                std::vector<PicturePoint> points;
                for (const Vec3 p : way) points.push_back(plot.at(p));
                append_way(paths[piece.grade.value_or(link_grades.size())], points);
            }
        }
    }
    return paths;
}

/// Appends all grades: the picture next to this one has the same legend.
void TrailLines::append_grades_to(Legend& legend) const {
    const std::string to = survey_->partner_names();
    if (survey_->has_margins()) {
        legend.add({fmt::format("link margin to {}:", to)});
        for (std::size_t i = 0; i < link_grades.size(); ++i)
            legend.add(link_sample(link_grades[i].text, {.grade = i, .width = graded_width}));
    } else {
        legend.add(
            link_sample("link to " + to, {.grade = link_grades.size() - 1, .width = graded_width}));
    }
    legend.add(gap_sample("no link to " + to));
}

void TrailLines::append_to(Legend& legend) const {
    if (survey_) append_grades_to(legend);
    legend.add(
        {fmt::format("{} a dot every {}", survey_ ? "start, and" : "trail in the robot's colour,",
                     period_text(every_)),
         34, [](Svg& svg, PicturePoint p) {
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
