// SPDX-License-Identifier: MIT
#include "pictures/map/link_lines.hpp"

#include "experiment/reports/link_pairs.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "models/medium/medium.hpp"
#include "pictures/draw/arrow_head.hpp"
#include "pictures/map/link_grades.hpp"
#include "pictures/map/link_stroke.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace rovernet {
namespace {

constexpr std::size_t many = 500;  // lines, from which on they fill the picture

}  // namespace

LinkLines::LinkLines(const Network& network, Time at, std::size_t storey) {
    const auto is_here = [&](NodeId node) {
        return network.scene().storeys().number_at(network.legs().position(node, at).z) == storey;
    };
    for (NodeId node{0}; node.index() < network.size(); ++node.value)
        if (range_of(network.medium().stations().model(node))) has_margins_ = false;
    for (const LinkPair& pair : link_pairs(network, at, is_here)) {
        if (is_here(pair.from) && is_here(pair.to)) {
            lines_.push_back({pair.from, pair.to, pair.margin().value, pair.back.has_value()});
        } else {
            ++to_other_storeys_;
        }
    }
}

void LinkLines::draw(Svg& svg, const RobotMarks& robots, bool on_colors) const {
    constexpr double gap = 2;  // [px] between an arrow head and its robot
    const bool seams = on_colors && lines_.size() <= many;
    std::array<std::array<SvgPath, 2>, link_grades.size()> paths;  // by grade; one way, both ways
    std::array<SvgPath, link_grades.size()> heads;
    for (const auto& line : lines_) {
        const auto& from = robots[line.from];
        const auto& to = robots[line.to];
        const std::size_t grade = grade_of(line.margin);
        paths[grade][line.both_ways].move(from.at.x, from.at.y).line(to.at.x, to.at.y);
        if (line.both_ways) continue;
        append_arrow_head(heads[grade], from.at, to.at, to.radius + gap, link_grades[grade].width);
    }
    for (std::size_t i = 0; i < link_grades.size(); ++i) {
        for (const bool both_ways : {false, true}) {
            if (paths[i][both_ways].empty()) continue;
            if (seams)
                draw_link_stroke(svg, paths[i][both_ways].text(),
                                 {.grade = i, .dashed = !both_ways, .seam = true});
            draw_link_stroke(svg, paths[i][both_ways].text(), {.grade = i, .dashed = !both_ways});
        }
        if (heads[i].empty()) continue;
        svg.add("path", {{"d", heads[i].text()},
                         {"fill", ember.at(link_grades[i].shade)},
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
    std::array<bool, link_grades.size()> used{};
    std::optional<std::size_t> one_way;
    for (const auto& line : lines_) {
        used[grade_of(line.margin)] = true;
        if (!line.both_ways) one_way = grade_of(line.margin);
    }
    bool first = true;
    for (std::size_t i = 0; i < link_grades.size(); ++i) {
        if (!used[i]) continue;
        if (!has_margins_) {
            if (first) legend.add(link_sample("link", {i}));
            first = false;
            continue;
        }
        legend.add(link_sample(
            fmt::format("{}{}", first ? "link margin " : "", link_grades[i].text), {i}));
        first = false;
    }
    if (one_way) legend.add(link_sample("one way only", {.grade = *one_way, .dashed = true}));
    if (to_other_storeys_ == 0) return;
    legend.add({fmt::format("{} link{} to other storeys", to_other_storeys_,
                            to_other_storeys_ == 1 ? "" : "s"),
                0, [](Svg&, PicturePoint) {}});
}

}  // namespace rovernet
