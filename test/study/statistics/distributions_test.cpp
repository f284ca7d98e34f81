// SPDX-License-Identifier: MIT
#include "study/statistics/distributions.hpp"

#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace distributions_test {
using namespace rovernet;
using test::is_close;

namespace {

constexpr double stated_accuracy = 1e-14;       // relative; as distributions.hpp states
constexpr double closed_form_accuracy = 1e-14;  // relative; of some operations of the oracle

double level_of(const test::Vectors& vectors, std::size_t i) {
    return (1 - vectors.number(i, "confidence")) / vectors.number(i, "family");
}

}  // namespace

TEST_CASE(
    "distributions: critical values of t equal the test vectors detectable_shift to the stated "
    "accuracy") {
    const test::Vectors vectors("detectable_shift.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        CAPTURE(i);
        const double t = t_critical(vectors.number(i, "n") - 1, level_of(vectors, i));
        CHECK(is_close(t, vectors.number(i, "t"), stated_accuracy));
    }
}

TEST_CASE(
    "distributions: shifts that a t-test finds with power 0.8 equal the test vectors "
    "detectable_shift to the stated accuracy") {
    const test::Vectors vectors("detectable_shift.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        CAPTURE(i);
        const auto d = t_shift(vectors.number(i, "n") - 1, level_of(vectors, i), 0.8);
        REQUIRE(d);
        CHECK(is_close(*d, vectors.number(i, "d"), stated_accuracy));
    }
}

TEST_CASE(
    "distributions: a difference of half a standard deviation is found with 80 % power by 34 "
    "pairs, not by 33") {
    // n = 33.367: S. Champely's R package pwr, pwr.t.test(d = 0.5, power = 0.8, type = "paired").
    CHECK(*t_shift(32, 0.05, 0.8) / std::sqrt(33) > 0.5);
    CHECK(*t_shift(33, 0.05, 0.8) / std::sqrt(34) < 0.5);
}

TEST_CASE("distributions: a power slightly above the level of the test needs hardly any shift") {
    CHECK(*t_shift(9, 0.05, 0.05 + 1e-9) < 1e-3);  // the power grows with the square of it
}

TEST_CASE(
    "distributions: the shift for a wanted power is undefined where the tails of t are too heavy "
    "to compute it") {
    CHECK(t_shift(1, 6.5e-5, 0.8));
    CHECK(!t_shift(1, 6.3e-5, 0.8));
    CHECK(!t_shift(1, 1e-300, 0.8));
}

TEST_CASE(
    "distributions: tail probabilities of t equal the closed forms for 1 and 2 degrees of "
    "freedom") {
    for (const double t : {0.0, 0.01, 1.0, 3.0, 250.0}) {
        // arctan of 1/t keeps the digits of a small tail
        const double one = t == 0 ? 1 : 2 / std::numbers::pi * std::atan(1 / t);
        const double root = std::sqrt(2 + t * t);
        const double two = 2 / (root * (root + t));
        for (const double sign : {-1, 1}) {
            CHECK(is_close(t_exceeded(1, sign * t), one, closed_form_accuracy));
            CHECK(is_close(t_exceeded(2, sign * t), two, closed_form_accuracy));
        }
    }
    CHECK(t_exceeded(3, std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("distributions: cumulative binomial probabilities are the sums of their terms") {
    for (const std::size_t n : {1U, 2U, 7U, 30U}) {
        for (const double p : {0.05, 0.5, 0.9}) {
            double at_most = 0, term = std::pow(1 - p, n);
            for (std::size_t k = 0; k < n; ++k) {
                at_most += term;
                term *= static_cast<double>(n - k) / static_cast<double>(k + 1) * p / (1 - p);
                CHECK(std::abs(binomial_at_most(k, n, p) - at_most) < closed_form_accuracy);
                CHECK(std::abs(binomial_above(k, n, p) - (1 - at_most)) < closed_form_accuracy);
            }
        }
    }
}

}  // namespace distributions_test
