// SPDX-License-Identifier: MIT
// Places from levels, against the bound of Cramer and Rao as numpy gives it: rssi_crlb.csv.
#include "study/calibration/locator.hpp"

#include "models/propagation/log_distance.hpp"
#include "sim/random.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace locator_test {
using namespace rovernet;
using test::Vectors;

namespace {

std::vector<Vec3> anchors_of(const std::string& name) {
    if (name == "square10") return {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    if (name == "square20") return {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    if (name == "triangle10") return {{0, 0}, {10, 0}, {5, 5 * std::sqrt(3)}};
    return {{0, 0}, {5, 0}, {10, 0}};  // collinear10
}

LocatorSettings in_square(double exponent, double side = 10) {
    return {.model = LogDistance{.exponent = exponent, .sigma = Db{0}},
            .frequency = 2450_MHz,
            .low = {0, 0},
            .high = {side, side}};
}

/// Losses of the anchors at a place, each off by its own normal error.
std::vector<AnchorLoss> measured(const LocatorSettings& s, const std::vector<Vec3>& anchors,
                                 Vec3 at, double sigma, std::uint64_t draw) {
    std::vector<AnchorLoss> out;
    for (std::uint64_t i = 0; i < anchors.size(); ++i) {
        const double error =
            sigma * normal({.seed = 7, .purpose = Purpose::sample_time, .a = draw, .b = i});
        out.push_back(
            {anchors[i], test::OneLink{.from = anchors[i], .to = at}.loss(s.model) + error});
    }
    return out;
}

}  // namespace

TEST_CASE(
    "locator: the bound of the position error equals the closed form, for known and for unknown "
    "transmit power") {
    const Vectors vectors("rssi_crlb.csv");
    std::size_t checked = 0;
    for (std::size_t row = 0; row < vectors.size(); ++row) {
        LocatorSettings settings = in_square(vectors.number(row, "n"));
        const auto anchors = anchors_of(vectors.text(row, "anchors"));
        const Vec3 at{vectors.number(row, "x"), vectors.number(row, "y")};
        const Db sigma{vectors.number(row, "sigma_dB")};
        for (const bool known : {true, false}) {
            settings.knows_power = known;
            const auto bound = Locator(settings).bound(anchors, at, sigma);
            REQUIRE(bound);
            const double expected =
                vectors.number(row, known ? "CRLB_rms_m_P0known" : "CRLB_rms_m_P0unknown");
            CAPTURE(vectors.text(row, "anchors"));
            CHECK(std::abs(bound->value - expected) <= 1e-6 * expected);
            ++checked;
        }
    }
    CHECK(checked == 128);
}

TEST_CASE(
    "locator: at the position of an anchor, the bound is finite, because of the other anchors") {
    const LocatorSettings settings = in_square(2);
    const auto anchors = anchors_of("square10");
    for (const double off : {0.0, 1e-9, 1e-3}) {
        const Vec3 at{anchors[0].x + off, anchors[0].y, anchors[0].z};
        const auto bound = Locator(settings).bound(anchors, at, Db{4});
        CAPTURE(off);
        REQUIRE(bound);
        CHECK(std::isfinite(bound->value));
        CHECK(bound->value >= 0);
        CHECK(bound->value < 10);
    }
    // With one anchor more than there is, and itself alone: no place at all.
    CHECK_FALSE(Locator(settings).bound({anchors.data(), 1}, anchors[0], Db{4}));
}

TEST_CASE(
    "locator: there is no bound for anchors on one line, nor for two anchors with unknown power") {
    CHECK_FALSE(Locator(in_square(2)).bound(anchors_of("collinear10"), {7, 0}, Db{4}));
    LocatorSettings unknown = in_square(2);
    unknown.knows_power = false;
    const std::vector<Vec3> two{{0, 0}, {10, 0}};
    CHECK(Locator(in_square(2)).bound(two, {5, 5}, Db{4}));
    CHECK_FALSE(Locator(unknown).bound(two, {5, 5}, Db{4}));
}

TEST_CASE("locator: exact levels give the position with an error of at most 2 mm") {
    const auto anchors = anchors_of("square10");
    for (const bool known : {true, false}) {
        LocatorSettings settings = in_square(3);
        settings.knows_power = known;
        Locator locator(settings);
        for (const Vec3 at : {Vec3{5, 5}, Vec3{1.234, 8.765}, Vec3{9.9, 0.3}}) {
            auto losses = measured(settings, anchors, at, 0, 0);
            if (!known)
                for (AnchorLoss& each : losses) each.loss += 12.5;  // another power
            const Vec3 found = locator.locate(losses, 0);
            CAPTURE(at.x);
            CHECK(distance(found, at) <= 2e-3);
        }
    }
}

TEST_CASE("locator: over 10,000 draws the error at the centre is within 10 % of the bound") {
    const LocatorSettings settings = in_square(2);
    Locator locator(settings);
    const auto anchors = anchors_of("square10");
    const Vec3 at{5, 5};
    constexpr int draws = 10'000;
    double squares = 0;
    for (int i = 0; i < draws; ++i) {
        const Vec3 found =
            locator.locate(measured(settings, anchors, at, 4, static_cast<std::uint64_t>(i)), 0);
        squares += distance(found, at) * distance(found, at);
    }
    const double bound = locator.bound(anchors, at, Db{4})->value;
    CAPTURE(std::sqrt(squares / draws));
    CHECK(std::abs(std::sqrt(squares / draws) / bound - 1) <= 0.1);
}

}  // namespace locator_test
