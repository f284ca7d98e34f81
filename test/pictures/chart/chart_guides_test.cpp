// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_guides.hpp"

#include "test/pictures/chart/drawn_chart.hpp"
#include "test/pictures/draw/svg_elements.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace chart_guides_test {
using namespace rovernet;
using test::corners;
using test::drawn;
using test::middle;
using test::of_class;
using test::one_series;
using test::svg_elements;

namespace {

bool near(double a, double b) { return std::abs(a - b) <= 0.021; }  // [px]

Chart two_points() {
    Chart chart = one_series(ChartKind::scatter,
                             {{.x = 1, .y = 1, .x_low = 0.5, .x_high = 3}, {.x = 10, .y = 5}});
    chart.log_x = true;
    return chart;
}

}  // namespace

TEST_CASE("chart: a reference line given by two points passes through the marks at these points") {
    Chart chart = two_points();
    chart.guides.push_back({.points = {{.x = 1, .y = 1}, {.x = 10, .y = 5}}, .dashed = true});
    const auto svg = svg_elements(drawn(chart));
    const auto marks = of_class(svg, "mark");
    const auto line = of_class(svg, "guide");
    REQUIRE(line.size() == 1);
    const auto ends = corners(line[0]).at(0);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(near(ends.at(i).x, middle(marks.at(i)).x));
        CHECK(near(ends.at(i).y, middle(marks.at(i)).y));
    }
    CHECK(line[0].attributes.at("stroke-dasharray") != "none");
}

TEST_CASE("chart: an error bar of x values is a horizontal whisker to both sides of its mark") {
    const auto svg = svg_elements(drawn(two_points()));
    const auto whisker = corners(of_class(svg, "whisker").at(0)).at(0);
    const PicturePoint mark = middle(of_class(svg, "mark").at(0));
    CHECK(near(whisker.at(0).y, mark.y));
    CHECK(near(whisker.at(1).y, mark.y));
    CHECK(whisker.at(0).x < mark.x - 10);
    CHECK(whisker.at(1).x > mark.x + 10);
}

TEST_CASE("chart: a labelled band marks all y values up to a given limit") {
    Chart chart = two_points();
    chart.band = 0.5;
    chart.band_label = "nobody knows";
    const auto svg = svg_elements(drawn(chart));
    const auto bands = of_class(svg, "limit");
    REQUIRE(bands.size() == 1);
    CHECK(bands[0].number("height") > 5);
    CHECK(bands[0].number("y") > middle(of_class(svg, "mark").at(0)).y);
    bool told = false;
    for (const auto& each : svg) told = told || each.text == "nobody knows";
    CHECK(told);
}

}  // namespace chart_guides_test
