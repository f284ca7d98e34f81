// SPDX-License-Identifier: MIT
#include "study/validation/validation_report.hpp"

#include "study/validation/headline.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace validation_report_test {
using namespace rovernet;

namespace {

ValidationPanel small_panel() {
    return {.title = "office",
            .error_label = "error [dB]",
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

TEST_CASE("validation: the Pareto front leads from the cheapest to the most exact method") {
    CHECK(pareto_front(small_panel().points) == std::vector<std::size_t>{1, 3});
}

TEST_CASE(
    "validation: the Pareto front contains only methods that are significantly better than cheaper "
    "ones") {
    const auto front_of = [](double spread, std::size_t parts) {
        ValidationPanel panel{.error_label = "error [dB]"};
        for (int i = 0; i < 3; ++i) {
            panel.points.push_back({.label = std::string(1, static_cast<char>('a' + i)),
                                    .cost = {1.0 + i, 1, 1},
                                    .error = 3.0 - i});
            for (std::size_t k = 0; k < parts; ++k)
                panel.points.back().parts.push_back(
                    3.0 - i +
                    spread * (static_cast<int>(k + static_cast<std::size_t>(i)) % 4 - 1.5));
        }
        return pareto_front(panel.points);
    };
    using Front = std::vector<std::size_t>;
    CHECK(front_of(0.01, 20) == Front{0, 1, 2});
    CHECK(front_of(5, 20) == Front{0});
    CHECK(front_of(0.01, 5) == Front{0});     // too few to tell
    CHECK(front_of(0, 0) == Front{0, 1, 2});  // nothing is known but the values
    ValidationPanel panel = small_panel();
    panel.points[3].error_low = 0;
    panel.points[3].error_high = 1.6;  // meets that of the cheaper one
    CHECK(pareto_front(panel.points) == Front{1});
    CHECK(count(validation_svg({.name = "s", .title = "t", .truth = "", .panels = {panel}}),
                "surely nearer to the reference") == 1);
}

TEST_CASE(
    "validation: a value equal to its limit passes, and a single exceeded limit fails the "
    "validation") {
    Validation validation = small_validation();
    CHECK(validation.kept());
    validation.promises.push_back({"on the limit", "", 0, 0, 1});
    CHECK(validation.kept());
    validation.promises.push_back({"broken one", "ns", 2, 2.5, 1});
    CHECK(!validation.kept());
    CHECK(count(promises_page(validation), "| broken one | 1 | 2 ns | 2.5 ns | NO |") == 1);
}

TEST_CASE(
    "validation: the chart lists methods from cheap to expensive, with errors of 0 at the left "
    "end") {
    const std::string svg = validation_svg(small_validation().charts[0]);
    CHECK(count(svg, "class=\"guide\"") == 2);  // cheap, on both scales
    for (const char* name : {">cheap</text>", ">slow &amp; poor</text>", ">exact</text>"})
        CHECK(count(svg, name) == 1);
    CHECK(count(svg, "errors below 5e-06 are drawn at the left end") == 1);
    // From cheap to dear.
    CHECK(svg.find(">cheap</text>") < svg.find(">slow &amp; poor</text>"));
    CHECK(svg.find(">slow &amp; poor</text>") < svg.find(">exact</text>"));
}

TEST_CASE("validation: a panel in which every error is 0 is replaced by a sentence") {
    Validation validation = small_validation();
    ValidationPanel right = small_panel();
    right.title = "hall";
    for (ValidationPoint& point : right.points) point.error = 0;
    validation.charts[0].panels.push_back(right);
    CHECK(count(validation_svg(validation.charts[0]), "class=\"panel\"") == 1);
    const std::string page = accuracy_page(validation);
    CHECK(count(page,
                "There is no picture of the errors of \"hall\", because all these errors are 0.") ==
          1);
    CHECK(count(page, "[small.csv](accuracy/small.csv)") == 1);  // its numbers are there
}

TEST_CASE(
    "validation: a method is named the best only if it is significantly better than the others") {
    const auto all = [](const ValidationPoint&) { return true; };
    const auto words = [](double error) { return std::to_string(error).substr(0, 4) + " dB"; };
    const auto panel_of = [](std::size_t n) {
        ValidationPanel panel;
        for (const char* label : {"a", "b", "c", "d"}) panel.points.push_back({.label = label});
        for (std::size_t i = 0; i < n; ++i) {
            const double noise = i % 2 == 0 ? 1 : -1;
            panel.points[0].parts.push_back(2 + noise);
            panel.points[1].parts.push_back(2.1 - noise);  // nearly a's mean, far from its parts
            panel.points[2].parts.push_back(4 + 1.01 * noise);
            // By as much as its differences spread: 20 of them tell that, one would not.
            panel.points[3].parts.push_back(3 + noise + (i % 4 < 2 ? 1.2 : -1.2));
        }
        panel.points[0].error = 2;
        panel.points[1].error = 2.1;
        panel.points[2].error = 4;
        panel.points[3].error = 3;
        return panel;
    };
    const ValidationPanel many = panel_of(20), few = panel_of(5);
    const Nearest nearest = nearest_to_truth(many, all);
    CHECK(nearest.point == &many.points[0]);
    CHECK(nearest.alike == std::vector<const ValidationPoint*>{&many.points[1]});
    CHECK(nearest_text(nearest, words) == "a (2.00 dB) cannot be distinguished from b (2.10 dB)");
    // Five parts tell nothing apart, however far the means are.
    CHECK(nearest_to_truth(few, all).alike.size() == 3);
    // A candidate alone, and against one that is always worse, is the nearest.
    const Nearest without_b =
        nearest_to_truth(many, [](const ValidationPoint& p) { return p.label != "b"; });
    CHECK(nearest_text(without_b, words) == "a has the smallest error (2.00 dB)");
    CHECK(!nearest_to_truth(many, [](const ValidationPoint&) { return false; }).point);
}

TEST_CASE(
    "validation: a chart for contributors is on the page of promises, and not on the page of "
    "accuracy") {
    Validation validation = small_validation();
    validation.charts.push_back(validation.charts[0]);
    validation.charts[1].name = "code";
    validation.charts[1].title = "How?";
    validation.charts[1].for_contributors = true;
    const std::string accuracy = accuracy_page(validation), promises = promises_page(validation);
    CHECK(count(accuracy, "## Which one?") == 1);
    CHECK(count(accuracy, "## How?") == 0);
    CHECK(count(promises, "## Which one?") == 0);
    CHECK(count(promises, "## How?") == 1);
    CHECK(count(promises, "](../methods/accuracy/code.csv)") == 1);
}

TEST_CASE(
    "validation: if a chart continues another one, both are in one section, which states the "
    "reference once") {
    Validation validation = small_validation();
    validation.charts.push_back(validation.charts[0]);
    validation.charts[1].title = "And then?";
    validation.charts[1].continues = true;
    const std::string page = accuracy_page(validation);
    CHECK(count(page, "\n### And then?\n") == 1);
    CHECK(count(page, "True is `exact`.") == 1);
}

TEST_CASE(
    "headline chart: models are in order of cost; the reference model computed with fewer paths is "
    "never named the best") {
    const auto point = [](const char* label, const char* series, double cost, double error) {
        return ValidationPoint{.label = label,
                               .series = series,
                               .cost = {cost, cost, cost},
                               .error = error,
                               .details = {{"replications", 7}}};
    };
    Validation validation;
    CHECK_THROWS_AS(headline_svg(validation), std::out_of_range);
    validation.charts = {
        {.name = "path_loss",
         .title = "t",
         .truth = "",
         .panels = {
             {.title = "office",
              .points = {point("rays", "reference", 1000, 0), point("walls", "as given", 10, 0.2),
                         point("walls", "fitted", 10, 0.04), point("friis", "as given", 1, 0.4),
                         point("two_ray", "as given", 0.9, 0.4),
                         point("rays, order 1", "the reference with fewer paths", 100, 0.01)}}}}};
    const std::string svg = headline_svg(validation);
    CHECK(count(svg,
                ">In the office, the error of walls is 0.04 after the fit (0.2 "
                "before), at 1/100 of the cost of rays.</text>") == 1);
    CHECK(svg.find(">friis</text>") < svg.find(">walls</text>"));
    CHECK(svg.find(">walls</text>") < svg.find(">rays, order 1</text>"));
    CHECK(count(svg, ">two_ray</text>") == 0);  // the errors of friis
    CHECK(count(svg, ">0.04</text>") == 1);
    CHECK(count(svg, "Means of 7 runs") == 1);
}

TEST_CASE("validation: the HTML page of the results needs no other file and no script") {
    const std::string html = validation_html(small_validation());
    CHECK(count(html, "<svg") == 1);
    CHECK(count(html, "http") == count(html, "http://www.w3.org/"));
    CHECK(count(html, "<script") == 0);
    CHECK(count(html, "Take <code>cheap</code>.") == 1);
    CHECK(count(html, "kept one") == 1);
}

TEST_CASE("validation: the numbers of a chart are written as CSV, with one line per point") {
    const std::string csv = validation_csv(small_validation().charts[0]);
    CHECK(count(csv, "\n") == 5);
    CHECK(csv.starts_with("panel,method,series,cost_ns,"));
    CHECK(count(csv, "error_high,\"bias, mean [dB]\"\n") == 1);
    CHECK(count(csv, "office,cheap,fitted,10,9,12,2,1.5,2.5,0\n") == 1);
}

TEST_CASE("validation: the median cost of a method lies between its lowest and its highest cost") {
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
