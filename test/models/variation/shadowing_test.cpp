// SPDX-License-Identifier: MIT
#include "models/variation/shadowing_field.hpp"
#include "sim/random.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace shadowing_test {
using namespace rovernet;

namespace {

constexpr Meters decorrelation{10};
constexpr std::uint32_t seeds = 1000;

/// A place within a square kilometre, from a draw of its own.
Vec3 place(std::uint64_t seed, std::uint64_t index) {
    const auto draw = [&](std::uint64_t axis) {
        return 1000 * uniform({.seed = seed, .a = index, .b = axis});
    };
    return {draw(0), draw(1), 1};
}

Vec3 heading(std::uint64_t seed, std::uint64_t index) {
    const double angle = 6.283185307179586 * uniform({.seed = seed, .a = index, .b = 9});
    return {std::cos(angle), std::sin(angle), 0};
}

const std::vector<ShadowingField>& fields() {
    static const std::vector<ShadowingField> all = [] {
        std::vector<ShadowingField> made;
        for (std::uint32_t seed = 0; seed < seeds; ++seed)
            made.emplace_back(decorrelation, seed, 3);
        return made;
    }();
    return all;
}

/// Second moments of the field at two pairs of places, over seeds and places.
struct Moments {
    double xx = 0, yy = 0, xy = 0, x = 0, n = 0;
    double correlation() const { return xy / std::sqrt(xx * yy); }
    double variance() const { return xx / n; }
    double mean() const { return x / n; }
};

/// @param places  places(seed, i): two pairs
template <class Places>
Moments moments(Places places) {
    constexpr std::uint64_t looks = 8;
    Moments out;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const ShadowingField& field = fields()[seed];
        for (std::uint64_t i = 0; i < looks; ++i) {
            const auto [a, b, c, d] = places(seed, i);
            const double x = field(a, b), y = field(c, d);
            out.xx += x * x;
            out.yy += y * y;
            out.xy += x * y;
            out.x += x;
            ++out.n;
        }
    }
    return out;
}

struct Pairs {
    Vec3 a, b, c, d;
};

}  // namespace

TEST_CASE("shadowing field: both directions of a link agree to the last bit") {
    const ShadowingField field(decorrelation, 7, 1);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec3 a = place(1, i), b = place(2, i);
        CHECK(field(a, b) == field(b, a));
        CHECK(std::abs(field(a, b)) <= Shadowing::cut_sigmas);
    }
}

TEST_CASE(
    "shadowing field: the value depends on seed and replication, and is the same in each call") {
    const Vec3 a{3, 4, 1}, b{40, -2, 1};
    CHECK(ShadowingField(decorrelation, 7, 1)(a, b) == ShadowingField(decorrelation, 7, 1)(a, b));
    CHECK(ShadowingField(decorrelation, 7, 1)(a, b) != ShadowingField(decorrelation, 8, 1)(a, b));
    CHECK(ShadowingField(decorrelation, 7, 1)(a, b) != ShadowingField(decorrelation, 7, 2)(a, b));
}

TEST_CASE("shadowing field: values have mean 0 and variance 1, at any distance between the ends") {
    for (const double apart : {0.1, 3.0, 30.0}) {
        CAPTURE(apart);
        const Moments m = moments([&](std::uint64_t seed, std::uint64_t i) {
            const Vec3 a = place(seed, i), b = a + apart * heading(seed, i);
            return Pairs{a, b, a, b};
        });
        constexpr double four_sigma = 4 / 90.0;  // 1 / sqrt(n), n = 8,000
        CHECK(test::near(m.mean(), 0, four_sigma));
        CHECK(test::near(m.variance(), 1, 0.02 + four_sigma));
    }
}

TEST_CASE(
    "shadowing field: as either end of a link moves by D, the correlation is e^(-D / d_cor), as in "
    "the test vectors") {
    const test::Vectors vectors("field_correlation.csv");
    int rows = 0;
    for (std::size_t row = 0; row < vectors.size(); ++row) {
        const double moved = vectors.number(row, "D/dcor");
        const bool shown = moved == 0.1 || moved == 0.5 || moved == 1 || moved == 2;
        if (vectors.number(row, "K*dcor") != 50 || !shown) continue;
        ++rows;
        CAPTURE(moved);
        for (const bool first : {true, false}) {
            const Moments m = moments([&](std::uint64_t seed, std::uint64_t i) {
                const Vec3 a = place(seed, i), b = a + Vec3{0, 60, 0};
                const Vec3 way = moved * decorrelation.value * heading(seed, i);
                return first ? Pairs{a, b, a + way, b} : Pairs{a, b, a, b + way};
            });
            constexpr double noise = 0.025;  // of the sample; the spectrum's cut is in the vectors
            CHECK(test::near(m.correlation(), vectors.number(row, "truncated"), noise));
            CHECK(test::near(m.correlation(), vectors.number(row, "exp(-D/dcor)"), 0.03));
        }
    }
    CHECK(rows == 4);
}

TEST_CASE(
    "shadowing field: as both ends of a link move, the correlations for the two ends multiply") {
    const Moments m = moments([&](std::uint64_t seed, std::uint64_t i) {
        const Vec3 a = place(seed, i), b = a + Vec3{0, 80, 0};
        return Pairs{a, b, a + Vec3{3, 0, 0}, b + Vec3{0, 5, 0}};
    });
    CHECK(test::near(m.correlation(), std::exp(-0.8), 0.03));
}

TEST_CASE("shadowing field: the heights of the two ends have no effect") {
    const ShadowingField field(decorrelation, 7, 1);
    CHECK(field({1, 2, 0}, {30, 4, 9}) == field({1, 2, 5}, {30, 4, 0}));
}

}  // namespace shadowing_test
