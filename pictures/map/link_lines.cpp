// SPDX-License-Identifier: MIT
#include "pictures/map/link_lines.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "pictures/draw/arrow_head.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace rovernet {
namespace {

constexpr std::uint32_t most_linked = 5000;
constexpr std::size_t many = 500;  // lines, from which on they fill the picture

/// Style of lines.
struct Grade {
    double from;   // [dB] of margin
    double width;  // [px]
    double shade;  // on the scale
    const char* text;
};
constexpr std::array grades{
    Grade{0, 1.3, 0.0, "0 to 5 dB"},    Grade{5, 1.8, 0.25, "5 to 10 dB"},
    Grade{10, 2.4, 0.5, "10 to 20 dB"}, Grade{20, 3.0, 0.75, "20 to 30 dB"},
    Grade{30, 3.6, 1.0, "over 30 dB"},
};

std::size_t grade_of(double margin) {
    std::size_t i = grades.size() - 1;
    while (i > 0 && margin < grades[i].from) --i;
    return i;
}

/// Margin of the link from `from` to `to` [dB]; none if `to` cannot hear.
std::optional<double> link_margin(const Network& network, NodeId from, NodeId to, Time at) {
    const Medium& medium = network.medium();
    const Radio& sender = medium.stations().radio(from);
    const Db budget = link_budget(sender, medium.stations().radio(to));
    constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
    const double d = distance(medium.stations().antenna(from, at, network.legs()),
                              medium.stations().antenna(to, at, network.legs()));
    if (d > slack * medium.stations().model(from).reach(budget, sender.frequency).value)
        return std::nullopt;
    if (!medium.links().is_up(from, to, at, network.legs())) return std::nullopt;
    return medium.links().margin(from, to, at, network.legs()).value;
}

void stroke(Svg& svg, const std::string& data, std::size_t grade, bool dashed, bool seam) {
    const auto& look = grades[grade];
    svg.add("path", {{"d", data},
                     {"fill", "none"},
                     {"stroke", seam ? Color{0xff, 0xff, 0xff} : ember.at(look.shade)},
                     {"stroke-width", look.width + (seam ? 1.6 : 0)},
                     {"stroke-dasharray", dashed && !seam ? "7 4" : "none"}});
}

LegendItem sample(std::string text, std::size_t grade, bool dashed) {
    return {std::move(text), 30, [grade, dashed](Svg& svg, PicturePoint p) {
                SvgPath path, head;
                path.move(p.x, p.y).horizontal(p.x + 30);
                stroke(svg, path.text(), grade, dashed, false);
                if (!dashed) return;
                append_arrow_head(head, p, {p.x + 34, p.y}, 2, grades[grade].width);
                svg.add("path", {{"d", head.text()}, {"fill", ember.at(grades[grade].shade)}});
            }};
}

}  // namespace

LinkLines::LinkLines(const Network& network, Time at, std::size_t storey) {
    const auto robots = static_cast<std::uint32_t>(network.size());
    if (robots > most_linked) {
        throw RunError(fmt::format("links of {} robots make no picture; expected at most {}",
                                   robots, most_linked));
    }
    const auto is_here = [&](NodeId node) {
        return network.scene().storeys().number_at(network.legs().position(node, at).z) == storey;
    };
    for (std::uint32_t i = 0; i < robots; ++i) {
        const bool here = is_here(NodeId{i});
        if (range_of(network.medium().stations().model(NodeId{i}))) has_margins_ = false;
        for (std::uint32_t j = i + 1; j < robots; ++j) {
            const NodeId a{i}, b{j};
            const bool there_too = is_here(b);
            if (!here && !there_too) continue;
            const auto there = link_margin(network, a, b, at),
                       back = link_margin(network, b, a, at);
            if (!here || !there_too) {
                to_other_storeys_ += there || back;
            } else if (there && back) {
                lines_.push_back({a, b, std::min(*there, *back), true});
            } else if (there) {
                lines_.push_back({a, b, *there, false});
            } else if (back) {
                lines_.push_back({b, a, *back, false});
            }
        }
    }
}

void LinkLines::draw(Svg& svg, const RobotMarks& robots, bool on_colors) const {
    constexpr double gap = 2;  // [px] between an arrow head and its robot
    const bool seams = on_colors && lines_.size() <= many;
    std::array<std::array<SvgPath, 2>, grades.size()> paths;  // by grade; one way, both ways
    std::array<SvgPath, grades.size()> heads;
    for (const auto& line : lines_) {
        const auto& from = robots[line.from];
        const auto& to = robots[line.to];
        const std::size_t grade = grade_of(line.margin);
        paths[grade][line.both_ways].move(from.at.x, from.at.y).line(to.at.x, to.at.y);
        if (line.both_ways) continue;
        append_arrow_head(heads[grade], from.at, to.at, to.radius + gap, grades[grade].width);
    }
    for (std::size_t i = 0; i < grades.size(); ++i) {
        for (const bool both_ways : {false, true}) {
            if (paths[i][both_ways].empty()) continue;
            if (seams) stroke(svg, paths[i][both_ways].text(), i, !both_ways, true);
            stroke(svg, paths[i][both_ways].text(), i, !both_ways, false);
        }
        if (heads[i].empty()) continue;
        svg.add("path", {{"d", heads[i].text()},
                         {"fill", ember.at(grades[i].shade)},
                         {"stroke", "#ffffff"},
                         {"stroke-width", seams ? 1.0 : 0.0},
                         {"paint-order", "stroke"}});
    }
}

void LinkLines::keep_off(LabelPlaces& places, const RobotMarks& robots) const {
    if (lines_.size() > many) return;
    for (const auto& line : lines_) places.avoid(robots[line.from].at, robots[line.to].at);
}

void LinkLines::append_to(Legend& legend) const {
    std::array<bool, grades.size()> used{};
    std::optional<std::size_t> one_way;
    for (const auto& line : lines_) {
        used[grade_of(line.margin)] = true;
        if (!line.both_ways) one_way = grade_of(line.margin);
    }
    bool first = true;
    for (std::size_t i = 0; i < grades.size(); ++i) {
        if (!used[i]) continue;
        if (!has_margins_) {
            if (first) legend.add(sample("link", i, false));
            first = false;
            continue;
        }
        legend.add(
            sample(fmt::format("{}{}", first ? "link margin " : "", grades[i].text), i, false));
        first = false;
    }
    if (one_way) legend.add(sample("one way only", *one_way, true));
    if (to_other_storeys_ == 0) return;
    legend.add({fmt::format("{} link{} to other storeys", to_other_storeys_,
                            to_other_storeys_ == 1 ? "" : "s"),
                0, [](Svg&, PicturePoint) {}});
}

}  // namespace rovernet
