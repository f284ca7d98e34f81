// SPDX-License-Identifier: MIT
#include "models/medium/loss_bounds.hpp"

#include "models/medium/link_range.hpp"
#include "models/propagation/list.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace loss_bounds_test {
using namespace rovernet;

TEST_CASE(
    "loss bounds: the loss lies between the lower and the upper bound, which are close together") {
    const Propagation disc = Disc{.range = 100_m};
    for (const Propagation& model :
         {Propagation{Friis{}}, Propagation{LogDistance{.sigma = {0}}}, disc}) {
        test::Draw draw(3);
        LossBounds bounds;
        int computed = 0, wide = 0;
        const auto loss_at_distance = [&](double d) {
            ++computed;
            return loss_at(model, 2400_MHz, d);
        };
        for (int i = 0; i < 50'000; ++i) {
            const double d2 = std::pow(10, draw.uniform(0, 10));
            const auto [low, high] = bounds.at(d2, loss_at_distance);
            const double loss = loss_at(model, 2400_MHz, std::sqrt(d2));
            REQUIRE(low <= loss);
            REQUIRE(loss <= high);
            wide += high - low > 0.25;
        }
        CHECK(computed < 2500);
        CHECK(wide < 100);  // but where the disc ends
    }
}

TEST_CASE("loss bounds: for very short and very long distances the bounds are infinite") {
    LossBounds bounds;
    const auto never_asked = [](double) -> double {
        FAIL("asked");
        return 0;
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double d2 : {0.0, 0.99, 1e12, 1e300, infinity}) {
        const auto [low, high] = bounds.at(d2, never_asked);
        CHECK(low == -infinity);
        CHECK(high == infinity);
    }
}

}  // namespace loss_bounds_test
