// SPDX-License-Identifier: MIT
#include "pictures/draw/color.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace color_test {
using namespace rovernet;

namespace {

/// What luminance changes by from color to color at k / steps: the smallest change, by `sign`.
double least_rise(const ColorScale& scale, double sign, int steps) {
    double least = 1;
    for (int i = 0; i < steps; ++i) {
        const Color a = scale.at(i / double(steps)), b = scale.at((i + 1) / double(steps));
        least = std::min(least, sign * (luminance(b) - luminance(a)));
    }
    return least;
}

constexpr int colors = 255;
constexpr int fine = 5000;
constexpr double one_unit = 0.002;  // of luminance: what a unit of red, where it is light, makes

}  // namespace

TEST_CASE("color: luminance is 0 for black, 1 for white, and 0.2126 for red") {
    constexpr double rounding = 1e-12;
    CHECK(luminance({0, 0, 0}) == 0);
    CHECK(std::abs(luminance({255, 255, 255}) - 1) < rounding);
    CHECK(std::abs(luminance({255, 0, 0}) - 0.2126) < rounding);
    constexpr double half_a_digit = 0.00005;  // WCAG's own example: #808080 is 0.2159
    CHECK(std::abs(luminance({128, 128, 128}) - 0.2159) < half_a_digit);
}

TEST_CASE("color: the colour scale for areas gets steadily lighter from its low to its high end") {
    CHECK(least_rise(lagoon, 1, colors) >= 0);
    CHECK(least_rise(lagoon, 1, fine) > -one_unit);
    CHECK(luminance(lagoon.at(0)) < 0.07);
    CHECK(luminance(lagoon.at(1)) > 0.8);
}

TEST_CASE("color: the colour scale for lines gets steadily darker from its low to its high end") {
    CHECK(least_rise(ember, -1, colors) >= 0);
    CHECK(least_rise(ember, -1, fine) > -one_unit);
    CHECK(luminance(ember.at(0)) > 0.5);
    CHECK(luminance(ember.at(1)) < 0.05);
}

TEST_CASE("color: the colour scale for differences goes from blue over white to orange") {
    CHECK(balance.at(0.5) == Color{0xff, 0xff, 0xff});
    const Color low = balance.at(0), high = balance.at(1);
    CHECK(low.blue > low.red);
    CHECK(high.red > high.blue);
    for (int i = 0; i < 8; ++i) {
        const double rise = luminance(balance.at((i + 1) / 16.0)) - luminance(balance.at(i / 16.0));
        const double fall =
            luminance(balance.at((i + 8) / 16.0)) - luminance(balance.at((i + 9) / 16.0));
        CHECK(rise > 0.01);
        CHECK(fall > 0.01);
    }
}

TEST_CASE("color: neighbouring grades of a colour scale can be distinguished in grey") {
    constexpr double least = 0.01;  // of luminance, at the dark end
    for (int i = 0; i < 8; ++i) {
        CHECK(luminance(lagoon.at((i + 1) / 8.0)) - luminance(lagoon.at(i / 8.0)) > least);
    }
    for (int i = 0; i < 4; ++i) {
        CHECK(luminance(ember.at(i / 4.0)) - luminance(ember.at((i + 1) / 4.0)) > least);
    }
}

TEST_CASE(
    "color: a value beyond a colour scale gets the colour of the nearer end, NaN that of the low "
    "end") {
    CHECK(lagoon.at(-1) == lagoon.at(0));
    CHECK(lagoon.at(2) == lagoon.at(1));
    CHECK(lagoon.at(std::numeric_limits<double>::quiet_NaN()) == lagoon.at(0));
    CHECK(lagoon.at(1) == Color{0xff, 0xf3, 0x77});
}

TEST_CASE("color: a color is printed as hexadecimal text, and two colors are blended linearly") {
    CHECK(hex({30, 144, 255}) == "#1e90ff");
    CHECK(blend({200, 0, 10}, {100, 100, 10}, 0.25) == Color{125, 75, 10});
}

}  // namespace color_test
