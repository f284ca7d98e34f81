// SPDX-License-Identifier: MIT
#include "models/propagation/edges/fresnel.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fresnel_test {
using namespace rovernet;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool near(double a, double b, double within) { return std::abs(a - b) <= within; }
bool same_digits(double a, double b) { return near(a, b, 2e-14 * std::abs(b)); }

}  // namespace

TEST_CASE("fresnel: the auxiliary functions f and g equal values computed with 50 digits") {
    struct Row {
        double t, f, g;
    };
    // f and g by mpmath with 50 digits.
    constexpr std::array<Row, 13> rows{{
        {0.1, 0.49313182560662363, 0.40779855452993033},
        {0.5, 0.39920505852570224, 0.17364269961323775},
        {1.0, 0.27989340037682283, 0.061740852609645234},
        {1.75, 0.17726783486456371, 0.016841055120043476},
        {2.25, 0.13996918268645666, 0.0084578791976086487},
        {2.4999, 0.12641184012646713, 0.0062643549396608602},
        {2.5, 0.1264069204948636, 0.0062636346491221377},
        {2.75, 0.11516686453338377, 0.0047542931433679864},
        {3.5, 0.090765558315310835, 0.0023401756317289204},
        {6.0, 0.053039238763069722, 0.00046853214449887981},
        {20.0, 0.015915464074046107, 1.2665027655611813e-5},
        {1000.0, 0.00031830988618369392, 1.0132118364218378e-10},
        {1000000.0, 3.1830988618379067e-7, 1.0132118364233777e-19},
    }};
    for (const Row& row : rows) {
        CAPTURE(row.t);
        const auto [f, g] = math::fresnel_tail(row.t);
        CHECK(same_digits(f, row.f));
        CHECK(same_digits(g, row.g));
    }
}

TEST_CASE("fresnel: f and g decrease smoothly from 1/2, also where their formula changes") {
    CHECK(near(math::fresnel_tail(0).f, 0.5, 1e-15));
    CHECK(near(math::fresnel_tail(0).g, 0.5, 1e-15));
    math::FresnelTail before = math::fresnel_tail(0);
    for (double t = 1e-3; t < 10; t += 1e-3) {
        CAPTURE(t);
        const math::FresnelTail now = math::fresnel_tail(t);
        CHECK(now.f < before.f);
        CHECK(now.g < before.g);
        CHECK(now.f > 0);
        CHECK(now.g > 0);
        before = now;
    }
}

TEST_CASE("fresnel: C and S equal step-by-step integrals of cosine and sine") {
    // Simpson's rule with steps of 1e-3: its error to x = 4 is below 1e-10.
    const auto phase = [](double u) { return std::numbers::pi / 2 * u * u; };
    const double h = 1e-3;
    double c = 0, s = 0;
    for (int i = 0; i < 4000; ++i) {
        const double u = i * h;
        c += h / 6 * (std::cos(phase(u)) + 4 * std::cos(phase(u + h / 2)) + std::cos(phase(u + h)));
        s += h / 6 * (std::sin(phase(u)) + 4 * std::sin(phase(u + h / 2)) + std::sin(phase(u + h)));
        const auto [ours_c, ours_s] = math::fresnel(u + h);
        CHECK(near(ours_c, c, 1e-10));
        CHECK(near(ours_s, s, 1e-10));
    }
}

TEST_CASE("fresnel: for large x, C and S stay near 1/2, where a power series would diverge (S17)") {
    struct Row {
        double x, c, s;
    };
    // C and S by mpmath with 50 digits.
    constexpr std::array<Row, 10> rows{{
        {0.25, 0.24975915035654318, 0.0081756002357777558},
        {1.6, 0.36546168344048765, 0.63888768350938083},
        {3.0, 0.60572078929768563, 0.49631299896737504},
        {5.0, 0.56363118870401223, 0.49919138191711689},
        {8.0, 0.49980218037719714, 0.46021421439301448},
        {123.456, 0.50212351355041566, 0.50146234679082449},
        {1234.5678, 0.50013374928879836, 0.50022042678429777},
        {1000000.3, 0.50000004489634274, 0.49999968487234133},
        {12345678.9, 0.50000002426980382, 0.50000000870315578},
        {1000000000.7, 0.4999999999293102, 0.4999999996896387},
    }};
    for (const Row& row : rows) {
        CAPTURE(row.x);
        CHECK(near(math::fresnel(row.x).c, row.c, 1e-15));
        CHECK(near(math::fresnel(row.x).s, row.s, 1e-15));
        CHECK(math::fresnel(-row.x).c == -math::fresnel(row.x).c);
        CHECK(math::fresnel(-row.x).s == -math::fresnel(row.x).s);
    }
    CHECK(math::fresnel(infinity).c == 0.5);
    CHECK(math::fresnel(-infinity).s == -0.5);
    CHECK(std::isnan(math::fresnel(std::nan("")).c));
    CHECK(near(math::fresnel(0).c, 0, 1e-15));
}

}  // namespace fresnel_test
