// SPDX-License-Identifier: MIT
#include "models/propagation/disc.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace disc_test {
using namespace rovernet;
using test::loss_at;

TEST_CASE("disc: the loss is 0 up to the range, also exactly at the range") {
    CHECK(loss_at(Disc{.range = 100_m}, 0) == 0);
    CHECK(loss_at(Disc{.range = 100_m}, 99) == 0);
    CHECK(loss_at(Disc{.range = 100_m}, 100) == 0);
    CHECK(test::OneLink{.to = {3, 4, 0}}.loss(Disc{.range = 5_m}) == 0);
}

TEST_CASE("disc: at the next number above the range, the loss is 1000 dB") {
    CHECK(loss_at(Disc{.range = 100_m}, std::nextafter(100.0, 101.0)) == 1000);
    CHECK(loss_at(Disc{.range = 100_m}, 1e9) == 1000);
}

TEST_CASE("disc: with range 0 m, only robots at the same position are linked") {
    CHECK(loss_at(Disc{.range = 0_m}, 0) == 0);
    CHECK(loss_at(Disc{.range = 0_m}, 1e-9) == 1000);
}

TEST_CASE("disc: height differences count as distance") {
    CHECK(test::OneLink{.to = {0, 0, 11}}.loss(Disc{.range = 10_m}) == 1000);
}

TEST_CASE("disc: the frequency has no effect on the loss") {
    CHECK(loss_at(Disc{.range = 10_m}, 10, {1}) == 0);
    CHECK(loss_at(Disc{.range = 10_m}, 10.1, {1}) == 1000);
}

TEST_CASE("disc: a missing range is refused") {
    CHECK_THROWS_AS(Propagation{Disc{}}, std::invalid_argument);
}

TEST_CASE("disc: the reach is the range, but for a link budget of 1000 dB it is infinite") {
    CHECK(Disc{.range = 7_m}.reach(91_dB, 2450_MHz) == 7_m);
    CHECK(std::isinf(Disc{.range = 7_m}.reach(1000_dB, 2450_MHz).value));
}

}  // namespace disc_test
