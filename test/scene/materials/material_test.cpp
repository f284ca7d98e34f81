// SPDX-License-Identifier: MIT
#include "scene/materials/material.hpp"

#include <doctest/doctest.h>

namespace material_test {
using namespace rovernet;

namespace {

constexpr double usual = 100;  // [dB/m] of the propagation model

}  // namespace

TEST_CASE("material: a material without a loss of its own gets the loss of the propagation model") {
    const Material plain;
    CHECK(plain.follows_model());
    const WallRate rate = wall_rate(plain, 2450_MHz, usual);
    CHECK(rate.per_crossing == 0);
    CHECK(rate.per_metre == usual);
}

TEST_CASE(
    "material: a material's own loss replaces that of the propagation model, even if it is 0") {
    const WallRate crossing = wall_rate({.per_crossing = 3_dB}, 2450_MHz, usual);
    CHECK(crossing.per_crossing == 3);
    CHECK(crossing.per_metre == 0);
    const WallRate metre = wall_rate({.per_metre = DbPerMeter{7.5}}, 2450_MHz, usual);
    CHECK(metre.per_crossing == 0);
    CHECK(metre.per_metre == 7.5);
    const WallRate both =
        wall_rate({.per_crossing = 3_dB, .per_metre = DbPerMeter{7.5}}, 2450_MHz, usual);
    CHECK(both.per_crossing == 3);
    CHECK(both.per_metre == 7.5);
    const WallRate glassless = wall_rate({.per_metre = DbPerMeter{0}}, 2450_MHz, usual);
    CHECK(glassless.per_crossing == 0);
    CHECK(glassless.per_metre == 0);
}

TEST_CASE(
    "material: each crossing of a slab attenuates by the slab's loss at the signal's frequency") {
    const Material glass{.slab = ItuMaterial::glass, .thickness = 0.006_m};
    for (const Hertz f : {2450_MHz, 5200_MHz}) {
        const WallRate rate = wall_rate(glass, f, usual);
        CHECK(rate.per_crossing == slab_loss(ItuMaterial::glass, 0.006_m, f).value);
        CHECK(rate.per_metre == 0);
    }
}

}  // namespace material_test
