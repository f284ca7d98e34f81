// SPDX-License-Identifier: MIT
#include "models/propagation/friis.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace friis_test {
using namespace rovernet;
using test::loss_at;
using test::near;

namespace {

/// A few roundings of losses up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]

}  // namespace

TEST_CASE("friis: free-space losses equal the test vectors, and are never below 0 dB") {
    const test::Vectors vectors("friis.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_m");
        const double f = vectors.number(i, "f_Hz");
        CAPTURE(d);
        CAPTURE(f);
        const bool negative = vectors.text(i, "flag") == "PL<0";
        const double exact = negative ? 0 : vectors.number(i, "FSPL_dB_exact");
        CHECK(near(loss_at(Friis{}, d, {f}), exact, test::vector_tolerance));
    }
}

TEST_CASE("friis: twice the distance or twice the frequency costs 20 log10(2) dB") {
    const double step = 20 * std::log10(2.0);
    CHECK(near(loss_at(Friis{}, 200) - loss_at(Friis{}, 100), step, tolerance));
    CHECK(near(loss_at(Friis{}, 50, {4900e6}) - loss_at(Friis{}, 50), step, tolerance));
}

TEST_CASE("friis: the loss at distance 0 is 0") { CHECK(loss_at(Friis{}, 0) == 0); }

TEST_CASE("friis: the loss depends on the distance in three dimensions") {
    const test::OneLink link{.from = {1, 2, 3}, .to = {3, 5, 9}};
    CHECK(near(link.loss(Friis{}), loss_at(Friis{}, 7), tolerance));
}

TEST_CASE("friis: the reach is the distance at which the loss equals the budget") {
    const double reach = Friis{}.reach(80_dB, 2450_MHz).value;
    CHECK(near(loss_at(Friis{}, reach), 80, tolerance));
}

}  // namespace friis_test
