// SPDX-License-Identifier: MIT
#include "models/medium/point_sieve.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace point_sieve_test {
using namespace rovernet;

namespace {

constexpr std::uint32_t untouched = 0xdeadbeef;

/// What is kept of a part of some points, one look at a time.
struct Kept {
    std::vector<std::uint32_t> numbers;
    std::vector<float> squares;
};

/// Points on a coarse raster, so that many lie exactly on the border; a few are nowhere.
struct Points {
    std::vector<float> x, y;

    Points(test::Draw& draw, int count) {
        for (int i = 0; i < count; ++i) {
            const bool nowhere = draw.below(9) == 0;
            constexpr float nan = std::numeric_limits<float>::quiet_NaN();
            x.push_back(nowhere ? nan : static_cast<float>(draw.below(21) - 10));
            y.push_back(static_cast<float>(draw.below(21) - 10));
        }
    }
    /// What may be read behind the last would be kept if it counted.
    void pad() {
        x.resize(x.size() + PointSieve<true>::at_once, 0);
        y.resize(y.size() + PointSieve<true>::at_once, 0);
    }
    Kept near(std::uint32_t begin, std::uint32_t end, float squared_reach) const {
        Kept kept;
        for (std::uint32_t i = begin; i < end; ++i) {
            const float dx = x[i] - 1, dy = y[i] + 2;
            if (!(dx * dx + dy * dy <= squared_reach)) continue;
            kept.numbers.push_back(i);
            kept.squares.push_back(dx * dx + dy * dy);
        }
        return kept;
    }
};

template <bool squares_too, class Step>
void check(const Points& points, std::uint32_t begin, std::uint32_t end, float squared_reach) {
    const Kept expected = points.near(begin, end, squared_reach);
    const PointSieve<squares_too, Step> sieve(points.x.data(), points.y.data(), 1, -2,
                                              squared_reach);
    const std::size_t room = end - begin + sieve.at_once;
    std::vector<std::uint32_t> numbers(room + 1, untouched);
    std::vector<float> squares(room + 1, -1);
    const std::size_t count = sieve.sift(begin, end, numbers.data(), squares.data());
    REQUIRE(count == expected.numbers.size());
    for (std::size_t i = 0; i < count; ++i) {
        REQUIRE(numbers[i] == expected.numbers[i]);
        REQUIRE(squares[i] == (squares_too ? expected.squares[i] : -1));
    }
    REQUIRE(numbers.back() == untouched);
    REQUIRE(squares.back() == -1);
}

}  // namespace

TEST_CASE(
    "point sieve: exactly the points within reach pass, with and without vector instructions") {
    test::Draw draw(23);
    for (int count = 0; count < 40; ++count) {
        Points points(draw, count);
        points.pad();
        const auto all = static_cast<std::uint32_t>(count);
        for (std::uint32_t begin = 0; begin <= all; ++begin) {
            const std::uint32_t end =
                begin + static_cast<std::uint32_t>(draw.below(static_cast<int>(all - begin) + 1));
            for (const float squared_reach : {0.F, 25.F, 100.F, 1e9F}) {
                check<true, PlainSieveStep>(points, begin, end, squared_reach);
                check<false, PlainSieveStep>(points, begin, end, squared_reach);
                check<true, SieveStep>(points, begin, end, squared_reach);
                check<false, SieveStep>(points, begin, end, squared_reach);
            }
        }
    }
}

}  // namespace point_sieve_test
