// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_view.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace chart_view_test {
using namespace rovernet;

namespace {

constexpr double rounding = 1e-12;  // of sums of fractions
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Chart chart(ChartKind kind, std::vector<ChartPoint> points) {
    return {.kind = kind, .series = {{"s", std::move(points)}}};
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("chart view: a line goes through its points in the order of x, broken at a missing y") {
    const Chart lines =
        chart(ChartKind::lines,
              {{.x = 3, .y = 30}, {.x = 1, .y = 10}, {.x = 2, .y = no_number}, {.x = 4, .y = 40}});
    const auto points = view_of(lines).series[0];
    REQUIRE(points.size() == 3);
    CHECK((points[0].x == 1 && points[1].x == 3 && points[2].x == 4));
    CHECK_FALSE(points[0].joined);
    CHECK_FALSE(points[1].joined);
    CHECK(points[2].joined);
}

TEST_CASE(
    "chart view: values and interval ends that are infinite, huge or NaN are left out and "
    "counted") {
    const Chart lines = chart(ChartKind::lines, {{.x = no_number, .y = 1},
                                                 {.x = 1, .y = infinity},
                                                 {.x = 2, .y = 2e100},
                                                 {.x = 3, .y = 3, .low = -infinity, .high = 4},
                                                 {.x = 4, .y = 4}});
    const ChartView view = view_of(lines);
    CHECK(view.left_out == 4);
    CHECK(view.points == 2);
    CHECK_FALSE(view.series[0][0].low.has_value());
    CHECK(view.series[0][0].high == 4);
    CHECK(view.notes == Texts{"4 values left out: not finite"});
}

TEST_CASE(
    "chart view: a logarithmic axis omits points <= 0, but keeps whiskers with a low end <= 0") {
    Chart scatter =
        chart(ChartKind::scatter,
              {{.x = 0, .y = 1}, {.x = 1, .y = -1}, {.x = 2, .y = 2, .low = -1, .high = 3}});
    CHECK(view_of(scatter).points == 3);
    scatter.log_x = scatter.log_y = true;
    const ChartView view = view_of(scatter);
    CHECK(view.points == 1);
    CHECK(view.left_out == 2);
    CHECK(view.series[0][0].low == -1);
    CHECK(view.y_range.low() == 2);
    CHECK(view.notes == Texts{"2 values left out: not finite, or not above 0"});
}

TEST_CASE(
    "chart view: on an axis of words, numbers come first in ascending order, then the words in the "
    "order of the points") {
    const Chart bars = chart(ChartKind::bars, {{.category = "b", .y = 1},
                                               {.x = 20, .y = 2},
                                               {.category = "a", .y = 3},
                                               {.x = 3, .y = 4},
                                               {.x = no_number, .y = 5}});
    const ChartView view = view_of(bars);
    CHECK(view.words == Texts{"3", "20", "b", "a"});
    CHECK(view.left_out == 1);
    REQUIRE(view.points == 4);
    CHECK(view.series[0][0].y == 4);
    CHECK(view.series[0][2].y == 1);
}

TEST_CASE("chart view: if a point has a word as x, the x axis is an axis of words") {
    CHECK_FALSE(view_of(chart(ChartKind::lines, {{.x = 1, .y = 1}})).has_words);
    CHECK(view_of(chart(ChartKind::lines, {{.category = "w", .y = 1}})).has_words);
    CHECK(view_of(chart(ChartKind::heat_map, {{.x = 1, .y = 1}})).has_words);
    CHECK_FALSE(view_of(chart(ChartKind::cdf, {{.x = 1, .category = "w"}})).has_words);
}

TEST_CASE("chart view: a cdf counts the points at or below x") {
    const Chart cdf =
        chart(ChartKind::cdf, {{.x = 5}, {.x = 1}, {.x = no_number}, {.x = 1}, {.x = 9}});
    const ChartView view = view_of(cdf);
    REQUIRE(view.points == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(view.series[0][i].y == (static_cast<double>(i) + 1) / 4);
    }
    CHECK((view.series[0][1].x == 1 && view.series[0][2].x == 5));
    CHECK(view.left_out == 1);
}

TEST_CASE("chart view: bars begin at 0; if all bars would look equal, dots are drawn instead") {
    const auto bars = [](std::vector<double> values) {
        Chart out = chart(ChartKind::bars, {});
        for (const double y : values) out.series[0].points.push_back({.category = "w", .y = y});
        return out;
    };
    CHECK(view_of(bars({5, 10})).y_range.low() == 0);
    CHECK_FALSE(view_of(bars({5, 10})).dots);
    CHECK(view_of(bars({95, 100})).dots);
    CHECK(view_of(bars({95, 100})).y_range.low() == 95);
    CHECK(view_of(bars({-95, -100})).dots);
    CHECK_FALSE(view_of(bars({-95, 100})).dots);
    CHECK_FALSE(view_of(bars({-5, -10})).dots);
    CHECK(view_of(bars({-5, -10})).y_range.high() == 0);
    Chart log = bars({5, 10});
    log.log_y = true;
    CHECK(view_of(log).dots);
}

TEST_CASE("chart view: series with few points, or with words as x, have no band") {
    Chart lines = chart(ChartKind::lines, {});
    for (int i = 0; i < 6; ++i) {
        CHECK_FALSE(has_band(view_of(lines), 0));
        lines.series[0].points.push_back({.x = double(i), .y = 1});
    }
    CHECK(has_band(view_of(lines), 0));
    lines.series[0].points[0].category = "w";
    CHECK_FALSE(has_band(view_of(lines), 0));
}

TEST_CASE("chart view: bars at the same word of the x axis are side by side, centred at the word") {
    CHECK(std::abs(bar_offset(0, 1)) < rounding);
    CHECK(std::abs(bar_offset(0, 2) + 0.2) < rounding);
    CHECK(std::abs(bar_offset(1, 2) - 0.2) < rounding);
    CHECK(std::abs(bar_offset(2, 4) - bar_offset(1, 4) - bars_at_word / 4) < rounding);
}

}  // namespace chart_view_test
