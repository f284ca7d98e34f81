// SPDX-License-Identifier: MIT
#include "pictures/chart/fit_chart.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

namespace fit_chart_test {
using namespace rovernet;

namespace {

FitChart two_scenes() {
    return {.title = "Which model?",
            .subtitle = "This one.",
            .value_label = "error",
            .panels = {{"Office",
                        "rays",
                        {{"disc", {}, 0.24, 3e-5},
                         {"friis", 0.4, {}, 3e-5},
                         {"multi_wall", 0.13, 0.04, 2.4e-4, true}}},
                       {"Field", "two rays", {{"disc", {}, 0.8, 0.2, true}}}},
            .notes = {"A note."}};
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

/// Places along x of the dots of a class, the legend's first.
std::vector<double> places(const std::string& svg, const std::string& kind) {
    std::vector<double> out;
    const std::regex dot("class=\"" + kind + "\" cx=\"([0-9.]+)\"");
    for (std::sregex_iterator at(svg.begin(), svg.end(), dot), end; at != end; ++at)
        out.push_back(std::stod((*at)[1]));
    return out;
}

}  // namespace

TEST_CASE(
    "fit chart: a model's cost is printed with one digit, as a fraction or multiple of the "
    "reference model's cost") {
    CHECK(cost_text(2.4e-4) == "1/4,000");
    CHECK(cost_text(3e-5) == "1/30,000");
    CHECK(cost_text(1.0 / 1'600'000) == "1/2,000,000");
    CHECK(cost_text(0.22) == "1/5");
    CHECK(cost_text(0.9) == "1/2");
    CHECK(cost_text(1.1) == "the same");
    CHECK(cost_text(1.6) == "2 times");
    CHECK(cost_text(10) == "10 times");
}

TEST_CASE("fit chart: a row's least error is the smaller of its two errors, or its only error") {
    CHECK(FitRow{"a", 0.4, {}}.least_error() == 0.4);
    CHECK(FitRow{"a", {}, 0.3}.least_error() == 0.3);
    CHECK(FitRow{"a", 0.1, 0.3}.least_error() == 0.1);
    CHECK(std::isinf(FitRow{"a"}.least_error()));
}

TEST_CASE("fit chart: a hollow dot is the error before the fit, a filled dot the error after it") {
    const std::string svg = fit_chart_svg(two_scenes());
    const auto given = places(svg, "as-given"), fitted = places(svg, "fitted");
    REQUIRE(given.size() == 3);
    REQUIRE(fitted.size() == 4);
    // 0.4 - 0.13 and 0.8 - 0.24 lie on one scale, in two panels.
    const double unit = (given[1] - given[2]) / (0.4 - 0.13);
    CHECK(std::abs((fitted[3] - fitted[1]) / unit - (0.8 - 0.24)) < 1e-3);
    CHECK(count(svg, "class=\"guide\"") == 1);
}

TEST_CASE("fit chart: only the best row has its error printed as a number") {
    const std::string svg = fit_chart_svg(two_scenes());
    CHECK(count(svg, ">0.04</text>") == 1);
    CHECK(count(svg, ">0.24</text>") == 0);
    for (const char* text :
         {"Which model?", "compared with rays", "multi_wall", "1/4,000", "A note."})
        CHECK(count(svg, std::string(">") + text + "</text>") == 1);
}

}  // namespace fit_chart_test
