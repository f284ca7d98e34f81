// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_marks.hpp"

#include "pictures/draw/color.hpp"
#include "pictures/draw/label.hpp"
#include "pictures/draw/svg.hpp"
#include "test/pictures/chart/drawn_chart.hpp"
#include "test/pictures/draw/svg_elements.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace chart_marks_test {
using namespace rovernet;
using test::corners;
using test::drawn;
using test::middle;
using test::of_class;
using test::one_series;
using test::svg_elements;
using test::SvgElement;

namespace {

constexpr double rounding = 0.021;  // [px] of differences and sums of numbers with two decimals
constexpr double baseline = 4;      // [px] from a tick of the y axis down to its text's baseline
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool near(double a, double b) { return std::abs(a - b) <= rounding; }

bool has(const std::string& text, std::string_view word) { return text.find(word) != text.npos; }

/// Where the tick of that text stands on the y axis [px].
double y_tick(const std::vector<SvgElement>& svg, const std::string& text) {
    for (const auto& each : svg) {
        if (each.group == "y-texts" && each.text == text) return each.number("y") - baseline;
    }
    FAIL("no tick " << text);
    return 0;
}

/// Where the tick of that text stands on the x axis [px].
double x_tick(const std::vector<SvgElement>& svg, const std::string& text) {
    for (const auto& each : svg) {
        if (each.group == "x-texts" && each.text == text) return each.number("x");
    }
    FAIL("no tick " << text);
    return 0;
}

/// The ends of the whiskers in a path: their stems are the upright pieces.
std::vector<std::vector<PicturePoint>> stems(const SvgElement& path) {
    auto out = corners(path);
    std::erase_if(out, [](const auto& piece) { return piece[0].x != piece[1].x; });
    return out;
}

Chart ramp(ChartKind kind, int count) {
    Chart out = one_series(kind, {});
    for (int i = 0; i < count; ++i) {
        const double y = i / 10.0;
        out.series[0].points.push_back(
            {.x = double(i), .y = y, .low = y - 0.05, .high = y + 0.1, .n = 7});
    }
    return out;
}

}  // namespace

TEST_CASE("chart: marks stay inside the axes, even marks at the ends of an axis or side by side") {
    for (const ChartKind kind : {ChartKind::lines, ChartKind::scatter, ChartKind::bars}) {
        for (const std::size_t count : {1U, 2U, 6U, 12U}) {
            Chart chart{.kind = kind, .y_limits = {0, 1}};
            for (std::size_t i = 0; i < count; ++i) {
                ChartSeries series{"s" + std::to_string(i), {}};
                for (const double x : {0.0, 1.0})
                    for (const double y : {0.0, 1.0})
                        series.points.push_back({.x = x, .y = y, .low = 0.0, .high = 1.0});
                chart.series.push_back(std::move(series));
            }
            if (kind == ChartKind::bars)  // dots
                for (ChartSeries& series : chart.series)
                    for (ChartPoint& point : series.points)
                        point = {.x = point.x, .y = 0.99 + 0.01 * point.y};
            const auto svg = svg_elements(drawn(chart));
            auto pieces = corners(of_class(svg, "axes").at(0));
            std::erase_if(pieces, [](const auto& piece) { return piece.size() != 3; });
            REQUIRE(pieces.size() == 1);
            const auto& axes = pieces[0];
            const PicturePoint top = axes[0], bottom = axes[1], right = axes[2];
            const auto marks = of_class(svg, "mark");
            CHECK(marks.size() == 4 * count);
            for (const SvgElement& mark : marks) {
                const auto outline = corners(mark).at(0);
                for (const PicturePoint corner : outline) {
                    const bool inside = corner.x >= top.x && corner.x <= right.x &&
                                        corner.y >= top.y && corner.y <= bottom.y;
                    CHECK_MESSAGE(inside, count, " series: ", corner.x, " ", corner.y, " in ",
                                  top.x, " ", top.y, " ", right.x, " ", bottom.y);
                }
            }
        }
    }
}

TEST_CASE("chart: a point halfway between two ticks, in x and in y, is drawn midway between them") {
    for (const ChartKind kind : {ChartKind::lines, ChartKind::scatter}) {
        const auto svg = svg_elements(
            drawn(one_series(kind, {{.x = 0, .y = 0}, {.x = 5, .y = 0.5}, {.x = 10, .y = 1}})));
        const auto marks = of_class(svg, "mark");
        REQUIRE(marks.size() == 3);
        const PicturePoint p = middle(marks[1]);
        CHECK(near(p.y, (y_tick(svg, "0") + y_tick(svg, "1.0")) / 2));
        CHECK(near(p.x, (x_tick(svg, "0") + x_tick(svg, "10")) / 2));
        CHECK(near(middle(marks[2]).y, y_tick(svg, "1.0")));
    }
}

TEST_CASE(
    "chart: on logarithmic axes, the geometric mean of two ticks is drawn midway between them") {
    Chart log = one_series(ChartKind::lines,
                           {{.x = 1, .y = 0.01}, {.x = 10, .y = 1}, {.x = 100, .y = 100}});
    log.log_x = log.log_y = true;
    const auto svg = svg_elements(drawn(log));
    const PicturePoint p = middle(of_class(svg, "mark").at(1));
    CHECK(near(p.x, (x_tick(svg, "1") + x_tick(svg, "100")) / 2));
    CHECK(near(p.y, (y_tick(svg, "0.01") + y_tick(svg, "100")) / 2));
}

TEST_CASE("chart: the edges of the band around a line are the ends of the error bars") {
    const auto svg = svg_elements(drawn(ramp(ChartKind::lines, 10)));
    const auto line = corners(of_class(svg, "line").at(0)).at(0);
    const auto band = corners(of_class(svg, "band").at(0)).at(0);
    REQUIRE(line.size() == 10);
    REQUIRE(band.size() == 20);
    const double unit = y_tick(svg, "0") - y_tick(svg, "1.0");
    for (std::size_t i = 0; i < line.size(); ++i) {
        const PicturePoint above = band[i], below = band[19 - i];
        CHECK((near(above.x, line[i].x) && near(below.x, line[i].x)));
        CHECK(near(line[i].y - above.y, 0.1 * unit));
        CHECK(near(below.y - line[i].y, 0.05 * unit));
    }
    CHECK(of_class(svg, "whisker").empty());
}

TEST_CASE("chart: with few points, each error bar is drawn as a whisker, and no band is drawn") {
    const auto svg = svg_elements(drawn(ramp(ChartKind::lines, 4)));
    CHECK(of_class(svg, "band").empty());
    const auto found = stems(of_class(svg, "whisker").at(0));
    const auto marks = of_class(svg, "mark");
    REQUIRE(found.size() == 4);
    REQUIRE(marks.size() == 4);
    const double unit = (y_tick(svg, "0") - y_tick(svg, "0.3")) / 0.3;
    for (std::size_t i = 0; i < 4; ++i) {
        const PicturePoint p = middle(marks[i]);
        CHECK(near(found[i][0].x, p.x));
        CHECK(near(found[i][0].y - p.y, 0.05 * unit));
        CHECK(near(p.y - found[i][1].y, 0.1 * unit));
    }
}

TEST_CASE(
    "chart: a band ends where an error bar is missing; an error bar without neighbours is a "
    "whisker") {
    Chart lines = ramp(ChartKind::lines, 9);
    lines.series[0].points[3].low.reset();
    lines.series[0].points[5].high.reset();
    const auto svg = svg_elements(drawn(lines));
    const auto pieces = corners(of_class(svg, "band").at(0));
    REQUIRE(pieces.size() == 2);
    CHECK((pieces[0].size() == 6 && pieces[1].size() == 6));
    CHECK(stems(of_class(svg, "whisker").at(0)).size() == 3);
}

TEST_CASE("chart: a line is broken where a value is missing") {
    Chart lines = ramp(ChartKind::lines, 9);
    lines.series[0].points[4].y = no_number;
    const std::string text = drawn(lines);
    const auto pieces = corners(of_class(svg_elements(text), "line").at(0));
    REQUIRE(pieces.size() == 2);
    CHECK((pieces[0].size() == 4 && pieces[1].size() == 4));
    CHECK(has(text, "1 value left out: not finite"));
}

TEST_CASE("chart: bands, whiskers and axis end at the limits of the quantity, such as 0 and 1") {
    for (const int points : {4, 9}) {  // whiskers, a band
        Chart ratio = one_series(ChartKind::lines, {});
        ratio.y_limits = {.low = 0, .high = 1};
        for (int i = 0; i < points; ++i) {
            const double y = i == 0 ? 0.05 : 0.95;
            ratio.series[0].points.push_back(
                {.x = double(i), .y = y, .low = y - 0.2, .high = y + 0.2});
        }
        const std::string text = drawn(ratio);
        CHECK_FALSE(has(text, "-0.2"));
        CHECK_FALSE(has(text, "1.2<"));
        const auto svg = svg_elements(text);
        const double top = y_tick(svg, "1.0"), bottom = y_tick(svg, "0");
        for (const char* shape : {"band", "whisker"}) {
            for (const auto& each : of_class(svg, shape)) {
                for (const auto& piece : corners(each)) {
                    for (const PicturePoint p : piece) {
                        CHECK(p.y >= top - rounding);
                        CHECK(p.y <= bottom + rounding);
                    }
                }
            }
        }
    }
}

TEST_CASE(
    "chart: overlapping whiskers are drawn side by side, each on the line of its own series") {
    Chart lines = ramp(ChartKind::lines, 4);
    lines.series.push_back({"second", lines.series[0].points});
    const auto svg = svg_elements(drawn(lines));
    const auto whiskers = of_class(svg, "whisker");
    REQUIRE(whiskers.size() == 2);
    const auto first = stems(whiskers[0]), second = stems(whiskers[1]);
    const auto drawn_lines = of_class(svg, "line");
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(second[i][0].x - first[i][0].x > 7);
        CHECK(near((first[i][0].x + second[i][0].x) / 2, x_tick(svg, std::to_string(i))));
        CHECK(near(corners(drawn_lines[1])[0][i].x, second[i][0].x));
    }
    for (auto& point : lines.series[1].points) {
        for (double* y : {&point.y, &*point.low, &*point.high}) *y += 9;
    }
    const auto apart = svg_elements(drawn(lines));
    for (const auto& each : of_class(apart, "whisker")) {
        CHECK(near(stems(each)[2][0].x, x_tick(apart, "2")));
    }
}

TEST_CASE("chart: overlapping points of a scatter chart are drawn side by side") {
    Chart scatter = one_series(ChartKind::scatter, {});
    for (int i = 0; i < 5; ++i) {
        scatter.series[0].points.push_back(
            {.x = 26, .y = 0.1 * i, .low = 0.1 * i - 0.2, .high = 0.1 * i + 0.2, .label = "model"});
    }
    const std::string text = drawn(scatter);
    const auto svg = svg_elements(text);
    std::set<double> x;
    for (const auto& stem : stems(of_class(svg, "whisker").at(0))) x.insert(stem[0].x);
    CHECK(x.size() >= 4);
    for (const auto& each : svg) {
        if (each.text != "model") continue;
        const double left = each.number("x"), baseline_y = each.number("y");
        const Box label{left, baseline_y - 8, left + text_width("model", 11), baseline_y + 2};
        for (const auto& stem : stems(of_class(svg, "whisker").at(0))) {
            const double top = std::min(stem[0].y, stem[1].y);
            const double bottom = std::max(stem[0].y, stem[1].y);
            CHECK_FALSE(label.overlaps({stem[0].x - 0.5, top, stem[0].x + 0.5, bottom}));
        }
    }
}

TEST_CASE(
    "chart: a bar extends from 0 to its value, a whisker to the ends of the interval around the "
    "value") {
    Chart bars = one_series(ChartKind::bars, {{.category = "up", .y = 20, .low = 15, .high = 30},
                                              {.category = "down", .y = -10, .low = -12}});
    bars.series.push_back({"second", {{.category = "up", .y = 5}}});
    const auto svg = svg_elements(drawn(bars));
    const auto found = of_class(svg, "bar");
    REQUIRE(found.size() == 3);
    const double zero = y_tick(svg, "0"), unit = (zero - y_tick(svg, "20")) / 20;
    const auto top = [](const SvgElement& bar) { return bar.number("y"); };
    const auto bottom = [&](const SvgElement& bar) { return top(bar) + bar.number("height"); };
    CHECK((near(bottom(found[0]), zero) && near(top(found[0]), zero - 20 * unit)));
    CHECK((near(top(found[1]), zero) && near(bottom(found[1]), zero + 10 * unit)));
    CHECK((near(bottom(found[2]), zero) && near(top(found[2]), zero - 5 * unit)));
    const auto whiskers = stems(of_class(svg, "whisker").at(0));
    CHECK((near(whiskers[0][0].y, zero - 15 * unit) && near(whiskers[0][1].y, zero - 30 * unit)));
    CHECK((near(whiskers[1][0].y, zero + 12 * unit) && near(whiskers[1][1].y, zero + 10 * unit)));
    // Side by side around their word, and a whisker in the middle of its bar.
    const double first = found[0].number("x"), width = found[0].number("width");
    CHECK(near(found[2].number("x"), first + width));
    CHECK(near(first + width, x_tick(svg, "up")));
    CHECK(near(whiskers[0][0].x, first + width / 2));
}

TEST_CASE("chart: if bars would look equal, dots are drawn instead") {
    const auto svg = svg_elements(drawn(one_series(
        ChartKind::bars, {{.category = "a", .y = 95, .low = 94}, {.category = "b", .y = 100}})));
    CHECK(of_class(svg, "bar").empty());
    const auto marks = of_class(svg, "mark");
    REQUIRE(marks.size() == 2);
    CHECK(near(middle(marks[0]).x, x_tick(svg, "a")));
    CHECK(near(middle(marks[0]).y, y_tick(svg, "95")));
    CHECK(near(middle(marks[1]).y, y_tick(svg, "100")));
}

TEST_CASE("chart: the steps of a cdf rise by the share of points at each x") {
    const auto svg = svg_elements(
        drawn(one_series(ChartKind::cdf, {{.x = 0}, {.x = 10}, {.x = 10}, {.x = 20}})));
    const auto line = corners(of_class(svg, "line").at(0)).at(0);
    const double zero = y_tick(svg, "0"), unit = zero - y_tick(svg, "1.0");
    const auto height_at = [&](double x) {  // of the last step that begins at x or before
        double y = zero;
        for (const auto& p : line) {
            if (p.x <= x + rounding) y = p.y;
        }
        return (zero - y) / unit;
    };
    CHECK(near(height_at(x_tick(svg, "0")), 0.25));
    CHECK(near(height_at(x_tick(svg, "8")), 0.25));
    CHECK(near(height_at(x_tick(svg, "10")), 0.75));
    CHECK(near(height_at(x_tick(svg, "20")), 1));
    CHECK(near(line.front().y, zero));
    for (std::size_t i = 1; i < line.size(); ++i) {
        CHECK((line[i].x == line[i - 1].x || line[i].y == line[i - 1].y));
        CHECK((line[i].x >= line[i - 1].x && line[i].y <= line[i - 1].y));
    }
}

TEST_CASE(
    "chart: in a heat map, each cell is at its labels on both axes and has the colour of its "
    "value") {
    Chart heat = one_series(ChartKind::heat_map, {{.x = 1, .y = 0}, {.x = 2, .y = 50}});
    heat.series.push_back({"above", {{.x = 2, .y = 100}}});
    const std::string text = drawn(heat);
    const auto svg = svg_elements(text);
    const auto cells = of_class(svg, "cell");
    REQUIRE(cells.size() == 3);
    CHECK(cells[0].attributes.at("fill") == hex(lagoon.at(0)));
    CHECK(cells[1].attributes.at("fill") == hex(lagoon.at(0.5)));
    CHECK(cells[2].attributes.at("fill") == hex(lagoon.at(1)));
    for (const auto& [cell, x, y] : {std::tuple{cells[0], "1", "s"}, std::tuple{cells[1], "2", "s"},
                                     std::tuple{cells[2], "2", "above"}}) {
        CHECK(near(cell.number("x") + cell.number("width") / 2, x_tick(svg, x)));
        CHECK(near(cell.number("y") + cell.number("height") / 2, y_tick(svg, y)));
    }
    CHECK(y_tick(svg, "above") < y_tick(svg, "s"));
    CHECK(of_class(svg, "missing").size() == 1);
    CHECK(corners(of_class(svg, "missing")[0]).size() == 2);
    CHECK(has(text, "no value"));
}

TEST_CASE("chart: if every cell of a heat map has a value, no cell is shown as missing") {
    const std::string text =
        drawn(one_series(ChartKind::heat_map, {{.x = 1, .y = 0}, {.x = 2, .y = 1}}));
    CHECK_FALSE(has(text, "no value"));
    CHECK(of_class(svg_elements(text), "missing").empty());
}

TEST_CASE("chart: a heat map prints values only in cells that are large enough") {
    Chart heat = one_series(ChartKind::heat_map, {{.x = 0, .y = 0.25}, {.x = 1, .y = 0.875}});
    CHECK(has(drawn(heat), ">0.250</text>"));
    for (int i = 2; i < 60; ++i) heat.series[0].points.push_back({.x = double(i), .y = 0.5});
    CHECK_FALSE(has(drawn(heat), ">0.250</text>"));
}

TEST_CASE("chart: a heat map prints values in dark on light cells, and in white on dark cells") {
    for (const auto& each : svg_elements(
             drawn(one_series(ChartKind::heat_map, {{.x = 1, .y = 0}, {.x = 2, .y = 1}})))) {
        if (each.group != "cells" || each.name != "text") continue;
        CHECK(each.attributes.at("fill") == (each.text == "0" ? "#ffffff" : "#111111"));
    }
}

TEST_CASE("chart: labels of a scatter chart overlap neither other labels nor marks") {
    Chart scatter = one_series(ChartKind::scatter, {});
    for (int i = 0; i < 60; ++i) {
        const double x = (i * 37) % 61, y = (i * 23) % 59;
        scatter.series[0].points.push_back({.x = x, .y = y, .label = fmt::format("label {}", i)});
    }
    const std::string text = drawn(scatter);
    std::vector<Box> boxes;
    for (const auto& each : svg_elements(text)) {
        if (each.name != "text" || !each.text.starts_with("label ")) continue;
        const double x = each.number("x"), y = each.number("y");
        boxes.push_back({x, y - 8, x + text_width(each.text, 11), y + 2});
    }
    CHECK(boxes.size() > 30);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) CHECK_FALSE(boxes[i].overlaps(boxes[k]));
        for (const auto& mark : of_class(svg_elements(text), "mark")) {
            const PicturePoint p = middle(mark);
            CHECK_FALSE(boxes[i].overlaps({p.x - 3, p.y - 3, p.x + 3, p.y + 3}));
        }
    }
    const auto homeless = 60 - boxes.size();
    if (homeless > 0) CHECK(has(text, fmt::format("no room for {} label", homeless)));
}

TEST_CASE(
    "chart: if a label has no room beside its mark, it is placed above or below the mark's "
    "whisker") {
    // Three whiskers too near to one another for a label between them, the middle one the longest
    // at one end or the other; the others' labels stand left and right of their marks.
    for (const double longer : {-0.1, 0.1}) {
        CAPTURE(longer);
        Chart scatter = one_series(ChartKind::scatter, {{.x = -40, .y = 0.5}, {.x = 40, .y = 0.5}});
        for (const double x : {-1, 0, 1}) {
            const double more = x == 0 ? longer : 0;
            scatter.series[0].points.push_back({.x = x,
                                                .y = 0.5,
                                                .low = 0.4 + std::min(more, 0.0),
                                                .high = 0.6 + std::max(more, 0.0),
                                                .label = fmt::format("model {}", x)});
        }
        scatter.y_limits = {.low = 0, .high = 1};
        const std::string text = drawn(scatter);
        CHECK_FALSE(has(text, "no room"));
        const auto svg = svg_elements(text);
        const auto whiskers = stems(of_class(svg, "whisker").at(0));
        REQUIRE(whiskers.size() == 3);
        int labels = 0;
        for (const auto& each : svg) {
            if (each.name != "text" || !each.text.starts_with("model ")) continue;
            ++labels;
            const double left = each.number("x"), y = each.number("y");
            const Box label{left, y - 8, left + text_width(each.text, 11), y + 2};
            for (const auto& stem : whiskers) {
                CHECK_FALSE(label.overlaps({stem[0].x - 3, std::min(stem[0].y, stem[1].y),
                                            stem[0].x + 3, std::max(stem[0].y, stem[1].y)}));
            }
            if (each.text != "model 0") continue;
            const auto& own = whiskers[1];
            CHECK((label.left < own[0].x && own[0].x < label.right));
            const double top = std::min(own[0].y, own[1].y), bottom = std::max(own[0].y, own[1].y);
            const double away = std::max(label.top - bottom, top - label.bottom);
            CHECK((away > 0 && away < 10));
        }
        CHECK(labels == 3);
    }
}

TEST_CASE(
    "chart: a whisker that reaches beyond a logarithmic axis ends at the axis, without a cap") {
    Chart scatter = one_series(ChartKind::scatter, {{.x = 1, .y = 10, .low = -1, .high = 20},
                                                    {.x = 2, .y = 5, .low = 4, .high = 6}});
    scatter.log_y = true;
    const auto whisker = of_class(svg_elements(drawn(scatter)), "whisker").at(0);
    CHECK(corners(whisker).size() == 5);  // two stems, three caps
    const auto svg = svg_elements(drawn(scatter));
    const auto axes = corners(of_class(svg, "axes").at(0)).back();
    CHECK(near(stems(whisker)[0][0].y, axes[1].y));
}

TEST_CASE("chart: series differ in colour, and in mark or dashes") {
    std::set<std::string> colors, dashes;
    Chart lines{.series = {}};
    for (int i = 0; i < 6; ++i) {
        lines.series.push_back({std::to_string(i), ramp(ChartKind::lines, 3).series[0].points});
    }
    for (const auto& line : of_class(svg_elements(drawn(lines)), "line")) {
        colors.insert(line.attributes.at("stroke"));
        dashes.insert(line.attributes.at("stroke-dasharray"));
    }
    CHECK(colors.size() == 6);
    CHECK(dashes.size() == 4);
}

TEST_CASE("chart: a mark has a tooltip with its values") {
    const std::string text = drawn(ramp(ChartKind::lines, 4));
    CHECK(has(text, "<title>s: 2, 0.2 (0.15 to 0.3), n = 7</title>"));
}

TEST_CASE(
    "chart: a series that belongs to a curve is drawn as hollow marks in the curve's colour, "
    "without a line") {
    Chart chart = one_series(ChartKind::lines, {{.x = 0, .y = 1}, {.x = 5, .y = 2}});
    chart.series.push_back({"beside", {{.x = 2, .y = 1.5}, {.x = 3, .y = 1.2}}, 0});
    const auto svg = svg_elements(drawn(chart));
    const auto lines = of_class(svg, "line");
    const auto marks = of_class(svg, "mark");
    REQUIRE(lines.size() == 2);
    CHECK(has(lines[0].attributes.at("d"), "L"));
    CHECK_FALSE(has(lines[1].attributes.at("d"), "L"));
    const auto count = [&](const char* key, const std::string& value) {
        return std::count_if(marks.begin(), marks.end(), [&](const SvgElement& mark) {
            return mark.attributes.at(key) == value;
        });
    };
    const std::string color = lines[0].attributes.at("stroke");
    CHECK(count("stroke", color) == 2);  // of the hollow ones
    CHECK(count("fill", "#ffffff") == 2);
    CHECK(count("fill", color) == 2);
}

TEST_CASE("chart: overlapping marks are moved apart only if they have error bars") {
    Chart chart{.kind = ChartKind::lines,
                .series = {{"a", {{.x = 1, .y = 1}, {.x = 2, .y = 2}}},
                           {"b", {{.x = 1, .y = 1}, {.x = 2, .y = 3}}}}};
    const auto lines = [&] {
        const std::string svg = chart_svg({&chart, 1});
        std::vector<std::string> out;
        const std::regex line("class=\"line\" d=\"M([0-9.]+) ");
        for (std::sregex_iterator at(svg.begin(), svg.end(), line), end; at != end; ++at)
            out.push_back((*at)[1]);
        return out;
    };
    REQUIRE(lines().size() == 2);
    CHECK(lines()[0] == lines()[1]);
    for (ChartSeries& series : chart.series) series.points[0].low = 0.5;
    CHECK(lines()[0] != lines()[1]);
}

TEST_CASE("chart: a line at zero is drawn only if the axis contains zero") {
    const auto zero_lines = [](double low) {
        const Chart chart{.kind = ChartKind::lines,
                          .series = {{"a", {{.x = 1, .y = low}, {.x = 2, .y = 100}}}}};
        const std::string svg = chart_svg({&chart, 1});
        const std::size_t from = svg.find("class=\"axes\"");
        const std::string axes = svg.substr(from, svg.find('>', from) - from);
        const std::regex across("M[0-9.]+ [0-9.]+H[0-9]{3}");  // longer than a tick
        return std::distance(std::sregex_iterator(axes.begin(), axes.end(), across), {});
    };
    CHECK(zero_lines(-10) == 1);
    CHECK(zero_lines(40) == 0);
}

}  // namespace chart_marks_test
