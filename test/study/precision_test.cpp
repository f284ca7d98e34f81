// SPDX-License-Identifier: MIT
#include "study/precision.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace rovernet;

namespace {

StudyTable wanting(double half_width, int most) {
    StudyTable study;
    study.precision = half_width;
    study.max_replications = most;
    return study;
}

// Mean 2, standard deviation 1; t of 3 degrees at 95 % is 3.182, the half-width 1.59.
const std::vector<double> four = {1.0, 3.0, 2.0 + 0.7071067811865476, 2.0 - 0.7071067811865476};

}  // namespace

TEST_CASE("precision: without one, or when it is reached, what was made is enough") {
    CHECK(replications_for(StudyTable{}, four, 4) == 4);
    CHECK(replications_for(wanting(1.6, 100), four, 4) == 4);
    CHECK(replications_for(wanting(1.5, 100), four, 4) == 5);
}

TEST_CASE("precision: an estimate asks for more, at most for twice as many, never for too many") {
    CHECK(replications_for(wanting(0.01, 100), four, 4) == 8);
    CHECK(replications_for(wanting(0.01, 6), four, 4) == 6);
    CHECK(replications_for(wanting(0.01, 4), four, 4) == 4);
    CHECK(replications_for(wanting(0.01, 2), four, 4) == 4);
}

TEST_CASE("precision: fewer than two values ask for twice as many runs") {
    CHECK(replications_for(wanting(1, 100), {}, 5) == 10);
    CHECK(replications_for(wanting(1, 100), std::vector<double>{0.5}, 5) == 10);
}

TEST_CASE("precision: the first metric of the study counts, or the delivery ratio") {
    StudyTable study;
    CHECK(first_metric(study) == "delivery_ratio");
    study.metrics = {"reach", "events"};
    CHECK(first_metric(study) == "reach");
}
