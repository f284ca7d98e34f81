// SPDX-License-Identifier: MIT
#include "models/propagation/raytrace_2007.hpp"

#include "models/propagation/itu_indoor.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace raytrace_2007_test {
using namespace rovernet;
using test::near;
using test::OneLink;

namespace {

/// One wall across the x axis at x = `at` [m], 2 m long.
Scene wall(double at, double thickness) {
    return Scene({.columns = 1,
                  .rows = 1,
                  .cell_width = thickness,
                  .cell_height = 2,
                  .origin = {at, -1, 0},
                  .cells = {Cell::occupied}});
}

}  // namespace

TEST_CASE("raytrace_2007: losses equal the test vectors, with and without a wall in between") {
    const test::Vectors vectors("thesis_raytrace.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_m");
        const double wall_m = vectors.number(i, "wall_m");
        CAPTURE(d);
        CAPTURE(wall_m);
        if (d < 1) continue;
        const Scene scene = wall_m > 0 ? wall(d / 2, wall_m) : Scene();
        const Raytrace2007 model{.wall_factor = vectors.number(i, "wall_factor")};
        const OneLink link{.to = {d, 0, 0}, .scene = &scene};
        CHECK(
            near(link.loss(model), vectors.number(i, "raytrace_loss_dB"), test::vector_tolerance));
    }
}

TEST_CASE(
    "raytrace_2007: on an open field the loss equals that of P.1238 with the same coefficient") {
    ItuIndoor indoor;
    indoor.coefficient = 25;
    for (const double d : {0.0, 0.5, 1.0, 7.0, 300.0}) {
        CHECK(test::loss_at(Raytrace2007{.coefficient = 25}, d) == test::loss_at(indoor, d));
    }
}

TEST_CASE("raytrace_2007: an oblique ray pays for its whole length inside the wall") {
    constexpr double tolerance = 1e-9;  // [dB], the scene's 1e-9 of a cell is less
    const Scene scene = wall(4, 0.3);
    const OneLink level{.to = {10, 0, 0}, .scene = &scene};
    const OneLink rising{.to = {10, 0, 10}, .scene = &scene};
    const Raytrace2007 model;
    const auto wall_loss = [&](const OneLink& link) {
        return link.loss(model) - link.loss(Raytrace2007{.wall_factor = 0});
    };
    CHECK(near(wall_loss(level), 30, tolerance));
    CHECK(near(wall_loss(rising), 30 * std::sqrt(2.0), tolerance));
}

TEST_CASE(
    "raytrace_2007: a computation that stops at the cut-off finds the same links as a full one") {
    test::Draw draw(2007);
    const Scene scene(test::random_map(draw, 40, 40, 10));
    int within = 0, beyond = 0;
    for (int i = 0; i < 3000; ++i) {
        const Raytrace2007 model{.coefficient = draw.uniform(15, 35),
                                 .wall_factor = draw.below(5) ? draw.uniform(0, 0.3) : 0};
        const OneLink link{.from = {draw.uniform(-5, 45), draw.uniform(-5, 45), draw.uniform(0, 3)},
                           .to = {draw.uniform(-5, 45), draw.uniform(-5, 45), draw.uniform(0, 3)},
                           .scene = &scene};
        const double exact = link.loss(model);
        // One budget anywhere, and three as near to the truth as they can be.
        for (const double budget :
             {draw.uniform(20, 200), exact, std::nextafter(exact, 0), std::nextafter(exact, 1e9)}) {
            const double hasty = link.loss(model, budget);
            CHECK((hasty <= budget) == (exact <= budget));
            if (exact <= budget) CHECK(hasty == exact);
            ++(exact <= budget ? within : beyond);
        }
    }
    CHECK(within > 1000);
    CHECK(beyond > 1000);
}

}  // namespace raytrace_2007_test
