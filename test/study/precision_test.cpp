// SPDX-License-Identifier: MIT
#include "study/precision.hpp"

#include "study/statistics/interval.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace precision_test {
using namespace rovernet;

namespace {

/// A study that is foremost about this metric.
StudyTable wanting(double half_width, int most, const char* metric = "latency_mean_s") {
    StudyTable study;
    study.metrics = {metric};
    study.precision = half_width;
    study.max_replications = most;
    return study;
}

/// Mean 2, standard deviation 1.0801; t of 9 degrees at 95 % is 2.2622.
const std::vector<double> ten = {0.5, 1, 1, 1, 2, 2, 3, 3, 3, 3.5};
constexpr double ten_reach = 0.7732;  // the half-width is 0.77266

}  // namespace

TEST_CASE("precision: if no precision is wanted, or if it is reached, no more runs are requested") {
    CHECK(replications_for(StudyTable{}, ten, 10) == 10);
    CHECK(replications_for(wanting(ten_reach, 100), ten, 10) == 10);
    CHECK(replications_for(wanting(0.75, 100), ten, 10) == 11);
}

TEST_CASE(
    "precision: each estimate at most doubles a point's replications, up to max_replications") {
    CHECK(replications_for(wanting(0.01, 100), ten, 10) == 20);
    CHECK(replications_for(wanting(0.01, 12), ten, 10) == 12);
    CHECK(replications_for(wanting(0.01, 10), ten, 10) == 10);
    CHECK(replications_for(wanting(0.01, 2), ten, 10) == 10);
}

TEST_CASE(
    "precision: each estimate adds at least 1/16 to a point's replications, if more are needed") {
    std::vector<double> many;
    for (int i = 0; i < 320; ++i) many.push_back(ten[static_cast<std::size_t>(i % 10)]);
    const double reach = *reached_precision(wanting(1, 1000), many).half_width;
    CHECK(replications_for(wanting(0.999 * reach, 1000), many, 320) == 340);
}

TEST_CASE(
    "precision: if a point has fewer than two values of the metric, its replications are doubled") {
    CHECK(replications_for(wanting(1, 100), {}, 5) == 10);
    CHECK(replications_for(wanting(1, 100), std::vector<double>{0.5}, 5) == 10);
}

TEST_CASE(
    "precision: two equal ratios do not reach a precision by betting, but would reach it by "
    "Student's t") {
    const std::vector<double> two = {0.9759, 0.9759};
    const StudyTable study = wanting(0.01, 1000, "delivery_ratio");
    CHECK_FALSE(reached_precision(study, two).enough);
    CHECK(replications_for(study, two, 2) == 4);
    const std::vector<double> many(500, 1.0);
    CHECK(reached_precision(study, many).enough);
}

TEST_CASE("precision: by Student's t at least ten values are needed, and not all of them equal") {
    const StudyTable study = wanting(0.5, 1000);
    const std::vector<double> nine = {1, 1.1, 1, 1.1, 1, 1.1, 1, 1.1, 1};
    CHECK(*reached_precision(study, nine).half_width < 0.05);
    CHECK_FALSE(reached_precision(study, nine).enough);
    CHECK(replications_for(study, nine, 9) == 10);
    const std::vector<double> equal(50, 1.0);
    CHECK_FALSE(reached_precision(study, equal).half_width);
    CHECK_FALSE(reached_precision(study, equal).enough);
    CHECK(replications_for(study, equal, 50) == 100);
}

TEST_CASE(
    "precision: the tested metric is the first of the study, or the delivery ratio if the study "
    "lists none") {
    StudyTable study;
    CHECK(first_metric(study) == "delivery_ratio");
    study.metrics = {"reach", "events"};
    CHECK(first_metric(study) == "reach");
}

}  // namespace precision_test
