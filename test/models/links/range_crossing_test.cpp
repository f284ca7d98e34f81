// SPDX-License-Identifier: MIT
#include "models/links/range_crossing.hpp"

#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace range_crossing_test {
using namespace rovernet;

TEST_CASE("range crossing: the times of entering and leaving the range equal the test vectors") {
    constexpr double tolerance = 1e-13;          // a few roundings, see the vectors' description
    constexpr double tangent_tolerance = 1e-12;  // where the discriminant nearly vanishes
    const test::Vectors vectors("range_crossing.csv");
    REQUIRE(vectors.size() == 19);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const std::string name = vectors.text(i, "case");
        CAPTURE(name);
        const auto passage = range_crossing({vectors.number(i, "rx"), vectors.number(i, "ry")},
                                            {vectors.number(i, "vx"), vectors.number(i, "vy")},
                                            vectors.number(i, "R"));
        const bool none = vectors.text(i, "t_in_exact") == "none" ||
                          vectors.text(i, "t_in_exact") == vectors.text(i, "t_out_exact");
        REQUIRE(passage.has_value() == !none);
        if (none) continue;
        const bool grazing = name.find("grazing") != std::string::npos;
        const double within = grazing ? tangent_tolerance : tolerance;
        const double in = vectors.number(i, "t_in_exact"), out = vectors.number(i, "t_out_exact");
        CHECK(std::abs(passage->enter - in) <= within * std::abs(in));
        CHECK(std::abs(passage->leave - out) <= within * std::abs(out));
    }
}

TEST_CASE(
    "range crossing: for a motion in any direction of space, the times equal the closed form") {
    constexpr double tolerance = 1e-12;  // of the rotation
    test::Draw draw(7);
    for (int i = 0; i < 1000; ++i) {
        const double miss = draw.uniform(0, 12), R = 10, speed = draw.uniform(0.1, 30);
        // The plane of the motion, by two directions at a right angle.
        const double u = draw.uniform(0, 6), w = draw.uniform(-1, 1), c = std::sqrt(1 - w * w);
        const Vec3 along{c * std::cos(u), c * std::sin(u), w}, aside{-std::sin(u), std::cos(u), 0};
        const auto passage = range_crossing(-50 * along + miss * aside, speed * along, R);
        CAPTURE(miss);
        REQUIRE(passage.has_value() == (miss < R));
        if (!passage || R - miss < 1e-3) continue;
        const double chord = std::sqrt((R - miss) * (R + miss));
        CHECK(std::abs(passage->enter - (50 - chord) / speed) <= tolerance * 50 / speed);
        CHECK(std::abs(passage->leave - (50 + chord) / speed) <= tolerance * 50 / speed);
    }
}

TEST_CASE(
    "range crossing: none is found if the robots rest, the range is not positive, or a value is "
    "infinite or NaN") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK_FALSE(range_crossing({1, 0, 0}, {}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, 0));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, -1));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, infinity));
    CHECK_FALSE(range_crossing({nan, 0, 0}, {1, 0, 0}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, nan, 0}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {infinity, 0, 0}, 10));
}

}  // namespace range_crossing_test
