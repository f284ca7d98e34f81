// SPDX-License-Identifier: MIT
#include "models/links/wall_passages.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wall_passages_test {
using namespace rovernet;

namespace {

constexpr double tolerance = 1e-9;  // [s] the clock's nanosecond

OccupancyGrid box(double x, double y, double width, double height, double yaw = 0) {
    return {.columns = 1,
            .rows = 1,
            .cell_width = width,
            .cell_height = height,
            .origin = {x, y, 0},
            .yaw = yaw,
            .cells = {Cell::occupied}};
}

/// One of the times of 10 s is `t`.
bool passes_at(const Scene& scene, const StraightMotion& a, const StraightMotion& b, double t,
               double within = tolerance) {
    std::vector<double> times;
    WallPassages(scene).times(a, b, 10, times);
    return std::any_of(times.begin(), times.end(),
                       [&](double s) { return std::abs(s - t) <= within; });
}

}  // namespace

TEST_CASE(
    "wall passages: if a line turns about one end, the times at which it passes visible corners "
    "are found") {
    const Scene scene(box(4, 2, 2, 1));
    const StraightMotion eye{{0, 0, 0}}, far{{10, 0, 0}, {0, 1, 0}};
    // The corner (x, y) is in line with (10, t) at t = 10 y / x.
    for (const double t : {2 / 0.6, 5.0, 3 / 0.6, 3 / 0.4}) CHECK(passes_at(scene, eye, far, t));
    std::vector<double> times;
    WallPassages(scene).times(eye, {{3, 0, 0}, {0, 1, 0}}, 10, times);
    CHECK(times.empty());  // it ends before the wall
    CHECK_FALSE(passes_at(scene, eye, {{5.5, 0, 0}, {0, 1, 0}}, 5.5 / 3));  // (6, 2) lies beyond
    WallPassages().times(eye, far, 10, times);
    CHECK(times.empty());
}

TEST_CASE(
    "wall passages: if an end of the line goes through a wall, the times of entry and exit are "
    "found") {
    const Scene scene(box(4, -1, 2, 2));
    for (const double speed : {1.0, 0.625})
        for (const double x : {4.0, 6.0}) {
            const StraightMotion through{{0, 0.5, 0}, {speed, 0, 0}}, above{{5, 9, 0}};
            CHECK(passes_at(scene, through, above, x / speed));
            CHECK(passes_at(scene, above, through, x / speed));
        }
}

TEST_CASE(
    "wall passages: if a line touches a corner and turns back, the time of the touch is found") {
    // The line from (t, 0) to (0, 10 - t) touches the parabola of the points
    // (t^2, (10 - t)^2) / 10 from below; both roots are one.
    constexpr double parted = 1e-6;  // [s] two equal roots, by the rounding of what parts them
    const StraightMotion right{{0, 0, 0}, {1, 0, 0}}, up{{0, 10, 0}, {0, -1, 0}};
    for (int tenths = 1; tenths < 100; ++tenths) {
        const double t = tenths / 10.0;
        CAPTURE(t);
        const Scene scene(box(t * t / 10, (10 - t) * (10 - t) / 10, 1, 1));
        CHECK(passes_at(scene, right, up, t, parted));
    }
}

TEST_CASE(
    "wall passages: where two walls of one material overlap, the intersection counts as a corner") {
    // A square on its tip, (5, 1) ... (7, 3) its lower right edge, which meets x = 5.5 at 1.5.
    const double side = std::sqrt(8.0), eighth = std::acos(-1.0) / 4;
    const OccupancyGrid tip = box(5, 1, side, side, eighth);
    OccupancyGrid post = box(5.5, 1, 3, 2);
    const StraightMotion a{{0, -3.5, 0}, {0, 1, 0}}, b{{11, 1.5, 0}};
    CHECK(passes_at(Scene({tip, post}, {Material{}}), a, b, 5));
    post.cell_materials = {1};
    CHECK_FALSE(passes_at(Scene({tip, post}, {Material{}, Material{}}), a, b, 5));
}

TEST_CASE(
    "wall passages: if an end of the line rises, the time is found at which it is as high as the "
    "wall") {
    const Scene scene(box(4, -1, 2, 2), {{.height = Meters{2}}});
    const StraightMotion lift{{5, 0, 0}, {0, 0, 0.5}}, post{{9, 0, 3}};
    CHECK(passes_at(scene, lift, post, 4));
    CHECK(passes_at(scene, post, lift, 4));
    // Over the near edge at x = 6: the height there is z + (3 - z) / 4 = 2 at z = 5 / 3.
    CHECK(passes_at(scene, lift, post, 10.0 / 3));
    const StraightMotion level{{5, 0.5, 1}, {0.1, 0, 0}}, beside{{9, 0.5, 1}, {0, 0.1, 0}};
    CHECK_FALSE(passes_at(scene, level, beside, 4));
}

TEST_CASE(
    "wall passages: if a line connects two storeys, the times at which it passes ceilings and feet "
    "of upper walls are found") {
    OccupancyGrid ground = box(-50, -50, 1, 1), upper = box(4, -1, 2, 2);
    ground.cells = {Cell::free};
    upper.origin.z = 3;
    const Scene scene({ground, upper}, {Material{}});
    const StraightMotion through{{0, 0.5, 4}, {1, 0, 0}}, beside{{5, 9, 4}};
    CHECK(passes_at(scene, through, beside, 4));
    CHECK(passes_at(scene, beside, through, 6));
    // The line from (0, 0) to (9, z) passes the ceiling at x = 27 / z, the wall's foot from x = 4.
    const StraightMotion below{{0, 0, 0}}, rising{{9, 0, 4}, {0, 0, 0.5}};
    CHECK(passes_at(scene, below, rising, 2 * (6.75 - 4)));
    upper.cells = {Cell::free};
    const Scene bare({ground, upper}, {Material{}});
    CHECK_FALSE(WallPassages(bare).empty());
    CHECK(passes_at(bare, below, {{9, 0, 1}, {0, 0, 0.5}}, 4));
}

}  // namespace wall_passages_test
