// SPDX-License-Identifier: MIT
#include "study/validation/validation_report.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace validation_report_test {
using namespace rovernet;

namespace {

ValidationPanel small_panel() {
    return {.title = "office",
            .error_label = "error [dB]",
            .joined = true,
            .points = {{.label = "cheap",
                        .series = "as given",
                        .cost = {10, 9, 11},
                        .error = 5,
                        .details = {{"bias, mean [dB]", -1}}},
                       {.label = "cheap",
                        .series = "fitted",
                        .cost = {10, 9, 12},
                        .error = 2,
                        .error_low = 1.5,
                        .error_high = 2.5,
                        .details = {{"bias, mean [dB]", 0}}},
                       {.label = "slow & poor",
                        .cost = {100, 90, 110},
                        .error = 3,
                        .details = {{"bias, mean [dB]", 2}}},
                       {.label = "exact",
                        .cost = {1000, 900, 1100},
                        .error = 0,
                        .details = {{"bias, mean [dB]", 0}}}}};
}

Validation small_validation() {
    return {.size = {},
            .charts = {{.name = "small",
                        .title = "Which one?",
                        .truth = "True is `exact`.",
                        .panels = {small_panel()},
                        .sentences = {"Take `cheap`."}}},
            .promises = {{"kept one", "dB", 1e-9, 1e-12, 3}},
            .left_out = {}};
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

}  // namespace

TEST_CASE("validation: the front has what nothing beats, from the cheapest to the most exact") {
    CHECK(pareto_front(small_panel().points) == std::vector<std::size_t>{1, 3});
}

TEST_CASE("validation: a promise is kept up to its limit, and one that is not breaks the whole") {
    Validation validation = small_validation();
    CHECK(validation.kept());
    validation.promises.push_back({"on the limit", "", 0, 0, 1});
    CHECK(validation.kept());
    validation.promises.push_back({"broken one", "ns", 2, 2.5, 1});
    CHECK(!validation.kept());
    CHECK(count(validation_page(validation), "| broken one | 1 | 2 ns | 2.5 ns | NO |") == 1);
}

TEST_CASE("validation: the picture joins what was fitted, and shows errors of 0 at its edge") {
    const std::string svg = validation_svg(small_validation().charts[0]);
    CHECK(count(svg, "class=\"guide\"") == 2);  // the front, and cheap
    CHECK(count(svg, ">cheap</text>") == 1);
    CHECK(count(svg, "slow &amp; poor") >= 1);
    CHECK(count(svg, "errors below 5e-06 stand at the lower edge") == 1);
    CHECK(count(svg, "left out") == 0);
}

TEST_CASE("validation: the page needs no other file") {
    const std::string html = validation_html(small_validation());
    CHECK(count(html, "<svg") == 1);
    CHECK(count(html, "http") == count(html, "http://www.w3.org/"));
    CHECK(count(html, "<script") == 0);
    CHECK(count(html, "Take <code>cheap</code>.") == 1);
    CHECK(count(html, "kept one") == 1);
}

TEST_CASE("validation: the numbers of a chart are a table with one line a point") {
    const std::string csv = validation_csv(small_validation().charts[0]);
    CHECK(count(csv, "\n") == 5);
    CHECK(csv.starts_with("panel,method,series,cost_ns,"));
    CHECK(count(csv, "error_high,\"bias, mean [dB]\"\n") == 1);
    CHECK(count(csv, "office,cheap,fitted,10,9,12,2,1.5,2.5,0\n") == 1);
}

TEST_CASE("validation: costs are those of the turns, the lowest first") {
    double calls = 0;
    const std::vector<TimedMethod> methods{{[&] { return ++calls; }, 1}, {[] { return 1.0; }, 10}};
    const auto costs = costs_in_turns(methods, {.turns = 3, .least_s = 1e-5});
    REQUIRE(costs.size() == 2);
    for (const TurnCost& cost : costs) {
        CHECK(cost.low <= cost.median);
        CHECK(cost.median <= cost.high);
    }
    CHECK(calls >= 6);  // a pass to warm up and one to measure, in each turn
}

}  // namespace validation_report_test
