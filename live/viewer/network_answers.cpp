// SPDX-License-Identifier: MIT
#include "live/viewer/network_answers.hpp"

#include "experiment/reports/link_pairs.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "pictures/map/contour.hpp"
#include "pictures/map/coverage.hpp"
#include "pictures/map/coverage_levels.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rovernet {
namespace {

/// Rectangle of the map, or of the robots and 10 m around them on an open field.
std::array<Vec3, 2> shown_area(const Network& network) {
    const Scene& scene = network.scene();
    if (!scene.open_field()) return {scene.lower_left(), scene.upper_right()};
    constexpr double around = 10;  // [m]
    Vec3 low = network.position(NodeId{0}), high = low;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const Vec3 p = network.position(NodeId{i});
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return {low - Vec3{around, around}, high + Vec3{around, around}};
}

/// Number with three decimals: short in JSON.
double rounded(double v) { return std::round(v * 1e3) / 1e3; }

/// End of the colour scale of differences [dB], above those of all but 2 % of the cells.
double scale_end(std::vector<double> sizes) {
    constexpr double share = 0.98, step = 5;  // step: [dB]
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), sizes.begin() + place, sizes.end());
    return step * std::max(1.0, std::ceil(sizes[static_cast<std::size_t>(place)] / step));
}

/// Contour as a list of x, y, x, y, ... [m]; a closed one ends where it begins.
Array points_of(const ContourLine& line) {
    Array points;
    const auto add = [&](Vec3 p) {
        points.emplace_back(rounded(p.x));
        points.emplace_back(rounded(p.y));
    };
    for (const Vec3 p : line.points) add(p);
    if (line.closed && !line.points.empty()) add(line.points.front());
    return points;
}

/// Appends the contours of a map. @param is_other  whether they are those of the other model
void append_contours(Array& list, const CoverageMap& map, const Transmitter& transmitter,
                     bool is_other) {
    constexpr double smoothing = 1.5;  // [cells]
    const auto range = range_of(transmitter.model);
    for (const ContourLevel& level : contour_levels(transmitter)) {
        Array lines;
        for (const ContourLine& line :
             contours(map, level.level, Meters{smoothing * map.cell_width}))
            lines.emplace_back(points_of(line));
        Table contour;
        contour.set("meaning", range ? "range" : level.meaning);
        if (range) {
            contour.set("range_m", range->value);
        } else {
            contour.set("level_dbm", level.level.value);
        }
        contour.set("other", is_other);
        contour.set("lines", std::move(lines));
        list.emplace_back(std::move(contour));
    }
}

}  // namespace

Table answer_coverage(const Network& network, const CoverageQuestion& question) {
    const NodeId robot = question.robot;
    const auto [low, high] = shown_area(network);
    const Transmitter own = transmitter(network, robot, robot, question.storey, network.now());
    const CoverageMap map = coverage(own, low, high, question.cells);
    const bool has_levels = !range_of(own.model);
    Array dbm, difference, list;
    for (const double level : map.dbm) dbm.push_back(has_levels ? Value(rounded(level)) : Value());
    append_contours(list, map, own, false);
    Table answer;
    if (question.other) {
        Transmitter other = own;
        other.model = *question.other;
        if (!has_levels || range_of(other.model))
            throw RunError(
                "the model disc computes no received levels, so there is no difference of levels "
                "to show");
        const CoverageMap with = coverage(other, low, high, question.cells);
        std::vector<double> sizes;
        for (std::size_t i = 0; i < map.dbm.size(); ++i) {
            difference.emplace_back(rounded(with.dbm[i] - map.dbm[i]));
            sizes.push_back(std::abs(with.dbm[i] - map.dbm[i]));
        }
        append_contours(list, with, other, true);
        answer.set("difference_db", std::move(difference));
        answer.set("most_db", scale_end(std::move(sizes)));
    }
    answer.set("columns", map.columns);
    answer.set("rows", map.rows);
    answer.set("left", map.lower_left.x);
    answer.set("bottom", map.lower_left.y);
    answer.set("cell_width", map.cell_width);
    answer.set("cell_height", map.cell_height);
    const auto [darkest, lightest] = color_range(map, contour_levels(own));
    answer.set("low_dbm", darkest);
    answer.set("high_dbm", lightest);
    answer.set("dbm", std::move(dbm));
    answer.set("contours", std::move(list));
    return answer;
}

Table answer_links(const Network& network, std::optional<NodeId> of) {
    constexpr std::size_t most = 5000;
    const auto pairs =
        link_pairs(network, network.now(), [&](NodeId node) { return !of || node == *of; });
    if (pairs.size() > most) {
        throw RunError(fmt::format(
            "{} links are too many for a picture; choose a robot to see its links", pairs.size()));
    }
    Array from, to, two_way, level, margin, back_level, back_margin;
    const auto append = [](Array& levels, Array& margins, const std::optional<LinkStrength>& link) {
        const bool has_level = link && link->has_level;
        levels.push_back(has_level ? Value(link->level.value) : Value());
        margins.push_back(has_level ? Value(link->margin.value) : Value());
    };
    for (const LinkPair& pair : pairs) {
        from.emplace_back(std::uint64_t{pair.from.value});
        to.emplace_back(std::uint64_t{pair.to.value});
        two_way.emplace_back(pair.back.has_value());
        append(level, margin, pair.there);
        append(back_level, back_margin, pair.back);
    }
    Table answer;
    answer.set("from", std::move(from));
    answer.set("to", std::move(to));
    answer.set("two_way", std::move(two_way));
    answer.set("level_dbm", std::move(level));
    answer.set("margin_db", std::move(margin));
    answer.set("back_level_dbm", std::move(back_level));
    answer.set("back_margin_db", std::move(back_margin));
    return answer;
}

}  // namespace rovernet
