// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"

#include "pictures/draw/svg.hpp"
#include "test/pictures/chart/drawn_chart.hpp"
#include "test/pictures/draw/svg_elements.hpp"
#include "test/pictures/draw/well_formed.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace chart_test {
using namespace rovernet;
using test::chart_kinds;
using test::drawn;
using test::of_class;
using test::one_series;
using test::svg_elements;

namespace {

constexpr double rounding = 0.021;  // [px] of differences and sums of numbers with two decimals
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool near(double a, double b) { return std::abs(a - b) <= rounding; }

bool has(const std::string& text, std::string_view word) { return text.find(word) != text.npos; }

/// Where the panels of a picture stand [px].
std::vector<PicturePoint> panels(const std::string& svg) {
    std::vector<PicturePoint> out;
    for (const auto& each : of_class(svg_elements(svg), "panel")) {
        const std::string& transform = each.attributes.at("transform");
        std::size_t end = 0;
        const std::string numbers = transform.substr(transform.find('(') + 1);
        const double x = std::stod(numbers, &end);
        out.push_back({x, std::stod(numbers.substr(end))});
    }
    return out;
}

/// One of each, with everything a chart can have.
std::vector<Chart> gallery(const std::string& text) {
    std::vector<Chart> out;
    for (const ChartKind kind : chart_kinds) {
        Chart each{.kind = kind,
                   .title = text,
                   .x_label = text,
                   .y_label = text,
                   .value_label = text,
                   .note = text};
        for (int s = 0; s < 3; ++s) {
            ChartSeries series{text + std::to_string(s)};
            for (int i = 0; i < 8; ++i) {
                const double y = 0.1 * i * s + 1;
                series.points.push_back(
                    {.x = i + 1.0, .y = y, .low = y - 0.3, .high = y + 0.2, .label = text});
            }
            if (kind == ChartKind::bars) series.points[0].category = text;
            each.series.push_back(series);
        }
        out.push_back(each);
    }
    return out;
}

}  // namespace

TEST_CASE("chart: an empty chart of any kind says that there are no results") {
    CHECK(has(chart_svg({}), "no results"));
    for (const ChartKind kind : chart_kinds) {
        for (const Chart& each : {Chart{.kind = kind}, one_series(kind, {}),
                                  one_series(kind, {{.x = no_number, .y = no_number}}),
                                  Chart{.kind = kind, .log_x = true}}) {
            const std::string text = drawn(each);
            CHECK(test::xml_fault(text) == "");
            CHECK(has(text, "no results"));
        }
    }
}

TEST_CASE(
    "chart: with any text a chart is well-formed XML, and nothing is drawn outside the picture") {
    const std::string markup = "</text><b a=\"1\">&amp;'\x01\xff %s \\n", longest(200, 'W');
    for (const auto& text : {markup, longest, longest + " " + markup, std::string()}) {
        const std::string svg = chart_svg(gallery(text), {.title = text});
        CHECK(test::xml_fault(svg) == "");
        CHECK_FALSE(has(svg, "<b a"));
        CHECK_FALSE(has(svg, "nan"));
        CHECK_FALSE(has(svg, "1000000000"));
    }
    for (const Chart& each : gallery(longest)) {
        const auto svg = svg_elements(drawn(each));
        for (const auto& element : svg) {
            if (element.name != "text" || element.group == "x-texts") continue;
            CHECK(text_width(element.text, element.number("font-size")) <= 640);
        }
    }
}

TEST_CASE(
    "chart: the legend has a title (such as the name of a varied key), in SVG and in gnuplot") {
    Chart lines = one_series(ChartKind::lines, {{.x = 1, .y = 1}, {.x = 2, .y = 2}});
    lines.legend_title = "ttl";
    const auto svg = svg_elements(drawn(lines));
    double title = -1, name = -1;
    for (const auto& each : svg) {
        if (each.group != "legend" || each.name != "text") continue;
        if (each.text == "ttl") title = each.number("x");
        if (each.text == "s") name = each.number("x");
    }
    CHECK((title >= 0 && name > title + text_width("ttl", 11)));
    CHECK(has(chart_gnuplot(lines), "title 'ttl'"));
}

TEST_CASE("chart: axes in gnuplot end at the limits of the plotted quantity, such as 0 and 1") {
    Chart lines = one_series(ChartKind::lines, {{.x = 1, .y = 0.1, .low = -0.3, .high = 0.5},
                                                {.x = 2, .y = 0.9, .low = 0.6, .high = 1.3}});
    lines.y_limits = {.low = 0, .high = 1};
    CHECK(has(chart_gnuplot(lines), "set yrange [0:1]"));
    CHECK_FALSE(has(chart_gnuplot(lines), "-0.3"));
}

TEST_CASE("chart: equal charts give equal bytes") {
    const auto charts = gallery("twice");
    CHECK(chart_svg(charts) == chart_svg(charts));
    CHECK(chart_svg(charts) == chart_svg(gallery("twice")));
}

TEST_CASE(
    "chart: charts of one point, equal values, many series or many points contain no inf or nan") {
    for (const ChartKind kind : chart_kinds) {
        Chart one = one_series(kind, {{.x = 3, .y = 3}}), same = one_series(kind, {}),
              many{.kind = kind}, large = one_series(kind, {});
        for (int i = 0; i < 5; ++i) same.series[0].points.push_back({.x = 7, .y = 7, .low = 7});
        for (int i = 0; i < 1000; ++i) {
            many.series.push_back(
                {std::to_string(i), {{.x = 1, .y = double(i)}, {.x = 2, .y = 5}}});
        }
        for (int i = 0; i < 10'000; ++i) {
            large.series[0].points.push_back(
                {.x = double(i), .y = std::fmod(i * 0.37, 5), .label = "p"});
        }
        Chart extreme = one_series(kind, {{.x = -1e100, .y = 1e100}, {.x = 1e100, .y = -1e100}});
        for (const Chart& each : {one, same, many, large, extreme}) {
            const std::string text = drawn(each);
            CHECK(test::xml_fault(text) == "");
            CHECK_FALSE(has(text, "nan"));
            CHECK_FALSE(has(text, "inf"));
            CHECK_FALSE(has(text, "no results"));
        }
        if (kind != ChartKind::heat_map) CHECK(has(drawn(many), "and 960 more"));
    }
}

TEST_CASE(
    "chart: labels below the x axis do not overlap, and labels that are too long are slanted") {
    for (const double largest : {1.0, 7.3e5, 1.234e6, 2e-9}) {
        const auto svg = svg_elements(drawn(
            one_series(ChartKind::lines, {{.x = 0.9 * largest, .y = 1}, {.x = largest, .y = 2}})));
        double end = 0;
        for (const auto& each : svg) {
            if (each.group != "x-texts" || each.name != "text") continue;
            const double width = text_width(each.text, each.number("font-size"));
            CHECK(each.number("x") - width / 2 > end);
            end = each.number("x") + width / 2;
        }
        CHECK(end > 100);
    }
    Chart bars = one_series(ChartKind::bars, {});
    for (const char* word : {"a", "b", "c"}) {
        bars.series[0].points.push_back({.category = word + std::string(10, 'w'), .y = 1});
    }
    CHECK_FALSE(has(drawn(bars), "rotate(-40"));
    for (auto& point : bars.series[0].points) point.category += std::string(20, 'w');
    CHECK(has(drawn(bars), "rotate(-40"));
}

TEST_CASE("chart: panels are arranged in rows, and the axes of a row are at the same height") {
    const auto charts = gallery("x");
    const auto two = panels(chart_svg(charts, {.width = 300, .height = 100}));
    REQUIRE(two.size() == 5);
    CHECK((two[0].y == two[1].y && two[2].y == two[3].y));
    CHECK((two[0].x == two[2].x && two[1].x - two[0].x > 300));
    const auto higher = panels(chart_svg(charts, {.width = 300, .height = 250}));
    CHECK(near(higher[2].y - higher[0].y, two[2].y - two[0].y + 150));
    const auto one = panels(chart_svg(charts, {.width = 300, .height = 100, .columns = 1}));
    CHECK((one[0].x == one[4].x && one[4].y > one[1].y));
}

TEST_CASE(
    "chart: all charts of a row leave as much room as the longest title and note of the row need") {
    std::vector<Chart> charts{one_series(ChartKind::lines, {{.x = 1, .y = 1}}), Chart{}, Chart{}};
    const auto plain = panels(chart_svg(charts));
    charts[0].title = "two lines " + std::string(40, 'w') + " " + std::string(40, 'w');
    const auto titled = panels(chart_svg(charts));
    CHECK(titled[0].y > plain[0].y + 30);
    CHECK(titled[1].y == titled[0].y);
    charts[0].note = "note";
    CHECK(panels(chart_svg(charts))[2].y > titled[2].y + 10);
}

TEST_CASE("chart: a layout whose width, height or number of columns is out of range is refused") {
    const Chart nothing;
    for (const ChartLayout& bad : {ChartLayout{.width = 100}, ChartLayout{.height = 0},
                                   ChartLayout{.height = no_number}, ChartLayout{.columns = 0}}) {
        CHECK_THROWS_AS(chart_svg({&nothing, 1}, bad), std::invalid_argument);
    }
}

}  // namespace chart_test
