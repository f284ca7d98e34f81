// SPDX-License-Identifier: MIT
#include "study/validation/cases/block_shadows.hpp"

#include "sim/units.hpp"
#include "test/models/propagation/soft_body.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace block_shadows_test {
using namespace rovernet;

TEST_CASE(
    "validation: losses behind blocks agree with the field of a wave, computed with 10 and 20 "
    "points per wavelength") {
    constexpr double wavelength = speed_of_light / 2450e6;  // [m]
    constexpr double accuracy = 0.3;  // [dB] of 10 points a wavelength, against 20
    for (const BlockShadow& shadow : block_shadows) {
        if (shadow.width > 0.6) continue;  // it takes its time
        std::vector<Vec3> places;
        for (int i = -15; i <= 15; ++i) places.push_back({8, shadow.y + 0.01 * i, 0});
        for (const int points : {10, 20}) {
            const double half = shadow.width / 2;
            const test::SoftBody block({{-half, 0}, {half, 0}, {half, 1}, {-half, 1}}, wavelength,
                                       points);
            CHECK(std::abs(block.loss({-8, 0.3, 0}, places) - shadow.loss) < accuracy);
        }
    }
}

}  // namespace block_shadows_test
