// SPDX-License-Identifier: MIT
#include "pictures/chart/budget_chart.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

namespace budget_chart_test {
using namespace rovernet;

namespace {

BudgetChart office() {
    return {.title = "A to B",
            .subtitle = "7 m",
            .power = 15,
            .steps = {{"antenna", 2}, {"path loss", -60}, {"wall <1>", -7}},
            .sensitivity = -75};
}

struct Bar {
    double from, to;
};

/// Ends of the bars of a class [px].
std::vector<Bar> bars(const std::string& svg, const std::string& kind) {
    std::vector<Bar> out;
    const std::regex bar("class=\"" + kind +
                         "\" x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"");
    for (std::sregex_iterator at(svg.begin(), svg.end(), bar), end; at != end; ++at)
        out.push_back({std::stod((*at)[1]), std::stod((*at)[1]) + std::stod((*at)[2])});
    return out;
}

bool has(const std::string& svg, const std::string& text) { return svg.find(text) != svg.npos; }

}  // namespace

TEST_CASE("budget chart: each bar begins where the previous bar ends; the last bar is the margin") {
    const std::string svg = budget_chart_svg(office());
    const auto gains = bars(svg, "gain"), losses = bars(svg, "loss"), margins = bars(svg, "margin");
    REQUIRE(gains.size() == 1);
    REQUIRE(losses.size() == 2);
    REQUIRE(margins.size() == 1);
    constexpr double rounding_px = 0.02;  // numbers of an SVG have two decimals
    CHECK(std::abs(gains[0].to - losses[0].to) < rounding_px);
    CHECK(std::abs(losses[0].from - losses[1].to) < rounding_px);
    CHECK(std::abs(margins[0].to - losses[1].from) < rounding_px);
    const double per_db = (gains[0].to - gains[0].from) / 2;
    CHECK(std::abs(losses[0].to - losses[0].from - 60 * per_db) < 60 * rounding_px);
    CHECK(std::abs(margins[0].to - margins[0].from - 25 * per_db) < 25 * rounding_px);
    CHECK(has(svg, ">received level</text>"));
    CHECK(has(svg, ">-50.0 dBm</text>"));
    CHECK(has(svg, ">+25.0 dB</text>"));
    CHECK(has(svg, "wall &lt;1&gt;"));
}

TEST_CASE(
    "budget chart: if the level is below the sensitivity, the last bar shows the missing "
    "decibels") {
    BudgetChart chart = office();
    chart.sensitivity = -40;
    const std::string svg = budget_chart_svg(chart);
    CHECK(has(svg, ">missing</text>"));
    CHECK(has(svg, ">-10.0 dB</text>"));
    CHECK(!has(svg, ">margin</text>"));
}

}  // namespace budget_chart_test
