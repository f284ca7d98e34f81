// SPDX-License-Identifier: MIT
#include "pictures/chart/dot_plot.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <regex>
#include <string>
#include <vector>

namespace dot_plot_test {
using namespace rovernet;

namespace {

/// Rows of dots that lie on one another: the same values and costs.
DotPlot crowded(std::size_t rows) {
    DotPlot plot{.title = "crowded",
                 .value_label = "error [dB]",
                 .beside_label = "cost [ns]",
                 .series = {"as given", "fitted"}};
    for (std::size_t i = 0; i < rows; ++i) {
        plot.rows.push_back(
            {.name = "model " + std::to_string(i),
             .dots = {{.series = 0, .value = 5, .beside = 10},
                      {.series = 1, .value = 4, .low = 3, .high = 6, .beside = 10}}});
    }
    return plot;
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

std::string drawn(const DotPlot& plot) { return dot_plot_svg({&plot, 1}, "", 640, 1); }

}  // namespace

TEST_CASE("dot plot: every name is printed completely, even if dots are close together") {
    const std::string svg = drawn(crowded(20));
    for (int i = 0; i < 20; ++i) CHECK(count(svg, ">model " + std::to_string(i) + "</text>") == 1);
    CHECK(count(svg, "class=\"whisker\"") == 20);
    CHECK(count(svg, "class=\"guide\"") == 40);  // on both scales
    CHECK(count(svg, "class=\"mark\"") == 82);   // and two in the legend
}

TEST_CASE("dot plot: any number of dots stays within its row") {
    DotPlot plot = crowded(1);
    plot.title = "";
    for (std::size_t i = 0; i < 6; ++i) {
        plot.series.push_back("");
        plot.rows[0].dots.push_back({.series = 2, .value = 5, .beside = 10});
    }
    const std::string svg = drawn(plot);
    const auto heights = [&](const char* pattern) {
        std::vector<double> out;
        const std::regex wanted(pattern);
        for (std::sregex_iterator at(svg.begin(), svg.end(), wanted), end; at != end; ++at)
            out.push_back(std::stod((*at)[1]));
        return out;
    };
    const double top = heights("<rect x=\"0\" y=\"([0-9.]+)\" width=\"640\" height=\"20\"").at(0);
    const auto joins = heights("class=\"guide\" d=\"M[0-9.]+[ ,]([0-9.]+)");
    REQUIRE(joins.size() == 2);
    for (const double first : joins) {
        CHECK(first >= top + 4.5);
        CHECK(first < top + 10);
    }
}

TEST_CASE(
    "dot plot: if dots have intervals around them, the legend has an entry for the intervals") {
    DotPlot plot = crowded(2);
    plot.whisker_label = "95 % interval";
    const std::string svg = drawn(plot);
    CHECK(count(svg, ">95 % interval</text>") == 1);
    CHECK(count(svg, "class=\"whisker\"") == 3);  // and the one in the legend
    for (DotRow& row : plot.rows) row.dots.back().high.reset();
    CHECK(count(drawn(plot), ">95 % interval</text>") == 0);
}

TEST_CASE("dot plot: the numbers below the main scale and below the second scale do not overlap") {
    DotPlot plot = crowded(1);
    plot.series = {""};
    for (const double most : {0.5, 9.0, 80.0, 100.0, 1200.0, 25000.0}) {
        for (const double least_cost : {1.0, 900.0, 1e6, 1e9}) {
            CAPTURE(most);
            CAPTURE(least_cost);
            plot.rows[0].dots = {{.value = most, .beside = least_cost},
                                 {.value = 0, .beside = 1000 * least_cost}};
            const std::string svg = drawn(plot);
            // Numbers of one height: those below the scales, from left to right.
            const std::regex number(
                "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*text-anchor=\"middle\"[^>]*>"
                "([0-9][^<]*)</text>");
            double end = -1e9, last = 0;
            for (std::sregex_iterator at(svg.begin(), svg.end(), number), none; at != none; ++at) {
                const double x = std::stod((*at)[1]),
                             half = 3.2 * static_cast<double>((*at)[3].length());
                if (x <= last) continue;
                CHECK(x - half > end);
                end = x + half;
                last = x;
            }
            CHECK(last > 0);
        }
    }
}

TEST_CASE("dot plot: a larger value is farther right on its scale") {
    DotPlot plot = crowded(1);
    plot.series = {""};
    plot.rows[0].dots = {
        {.value = 1, .beside = 1}, {.value = 2, .beside = 10}, {.value = 4, .beside = 100}};
    const std::string svg = drawn(plot);
    std::vector<double> x;
    const std::regex mark("class=\"mark\" d=\"M([0-9.]+)");
    for (std::sregex_iterator at(svg.begin(), svg.end(), mark), end; at != end; ++at)
        x.push_back(std::stod((*at)[1]));
    REQUIRE(x.size() == 6);
    CHECK(x[2] - x[1] == doctest::Approx(2 * (x[1] - x[0])).epsilon(0.01));  // linear
    CHECK(x[5] - x[4] == doctest::Approx(x[4] - x[3]).epsilon(0.01));        // logarithmic
    CHECK(x[3] > x[2]);
}

TEST_CASE("dot plot: a value of 0 is at the left end of a logarithmic scale") {
    DotPlot plot = crowded(1);
    plot.log = true;
    plot.least = 0.1;
    plot.rows[0].dots = {{.value = 0, .beside = 1}, {.value = 0.1, .beside = 1}};
    const std::string svg = drawn(plot);
    const std::regex mark("class=\"mark\" d=\"M([0-9.]+)");
    std::sregex_iterator at(svg.begin(), svg.end(), mark);
    const std::string first = (*at)[1];
    CHECK(first == (*++at)[1]);
}

TEST_CASE("dot plot: a grey band has an entry in the legend, and several plots are drawn in rows") {
    DotPlot plot = crowded(2);
    CHECK(count(drawn(plot), "class=\"limit\"") == 0);
    plot.band = 2;
    plot.band_label = "grey & why";
    const std::vector<DotPlot> plots(3, plot);
    const std::string svg = dot_plot_svg(plots, "three", 400, 2);
    CHECK(count(svg, "class=\"limit\"") == 3);
    CHECK(count(svg, "grey &amp; why") == 3);
    CHECK(count(svg, "class=\"panel\"") == 3);
    CHECK(svg.find("width=\"864\"") != std::string::npos);  // two of 400 px with 32 px around
    CHECK(svg == dot_plot_svg(plots, "three", 400, 2));
}

}  // namespace dot_plot_test
