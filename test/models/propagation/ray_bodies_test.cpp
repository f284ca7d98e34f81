// SPDX-License-Identifier: MIT
// Shadows of bodies: blocks, pillars, shelves, ends of walls.

#include "models/propagation/edges/diffraction.hpp"
#include "models/propagation/edges/edge_pair.hpp"
#include "models/propagation/edges/edge_row.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/rays.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "test/models/propagation/soft_body.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace ray_bodies_test {
using namespace rovernet;
using test::near;

namespace {

constexpr Hertz f{2450e6};
constexpr double wavelength = speed_of_light / 2450e6;  // [m]
const Material metal{.slab = ItuMaterial::metal, .thickness = 0.01_m};

/// A map of 20 m x 12 m around (0, 0).
Scene drawn(const std::function<bool(double, double)>& inside, Material material = {},
            double cell = 0.05) {
    OccupancyGrid grid;
    grid.columns = static_cast<int>(std::lround(20 / cell));
    grid.rows = static_cast<int>(std::lround(12 / cell));
    grid.cell_width = grid.cell_height = cell;
    grid.origin = {-10, -6};
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            grid.cells.push_back(inside((column + 0.5) * cell - 10, (row + 0.5) * cell - 6)
                                     ? Cell::occupied
                                     : Cell::free);
    return Scene(grid, {std::move(material)});
}
std::function<bool(double, double)> block(double x0, double y0, double x1, double y1) {
    return [=](double x, double y) { return x > x0 && x < x1 && y > y0 && y < y1; };
}

double loss(const Rays& model, const Scene& scene, Vec3 from, Vec3 to) {
    return test::OneLink{.frequency = f, .from = from, .to = to, .scene = &scene}.loss(model);
}

/// Places within some wavelengths, over which powers are averaged.
std::vector<Vec3> around(Vec3 at) {
    std::vector<Vec3> out;
    for (int i = -15; i <= 15; ++i) out.push_back(at + Vec3{0, 0.01 * i, 0});
    return out;
}
double mean_excess(const Rays& model, const Scene& scene, Vec3 from, Vec3 to) {
    double power = 0;
    const std::vector<Vec3> places = around(to);
    for (const Vec3 at : places)
        power += math::exp10(
            -(loss(model, scene, from, at) - free_space_db(distance(from, at), f)) / 10);
    return -10 * math::log10(power / static_cast<double>(places.size()));
}

double largest_step(const Rays& model, const Scene& scene, Vec3 from, Vec3 first, Vec3 last) {
    const int steps = static_cast<int>(distance(first, last) / 0.001);
    double worst = 0, before = loss(model, scene, from, first);
    for (int i = 1; i <= steps; ++i) {
        const double now =
            loss(model, scene, from, first + (static_cast<double>(i) / steps) * (last - first));
        worst = std::max(worst, std::abs(now - before));
        before = now;
    }
    return worst;
}

constexpr std::array both{RayDiffraction::knife_edge, RayDiffraction::utd};

}  // namespace

TEST_CASE("edge pair: if both edges touch the line of sight, the field equals its closed form") {
    for (const double along : {0.01, 0.5, 1.0, 4.0, 50.0}) {
        const double rho = std::sqrt(7.0 * 9 / ((7 + along) * (9 + along)));
        const math::Complex field = pair_field({7, along, 9, 0, 0}, wavelength);
        CHECK(near(20 * std::log10(std::abs(field)),
                   20 * std::log10(std::asin(rho) / std::numbers::pi), 0.02));
    }
}

namespace {

double row_loss(std::vector<RowCorner> corners, double length) {
    const EdgeRow row(std::move(corners), length, wavelength);
    return -20 * std::log10(std::abs(row.field_without(std::vector<char>(8, 0))));
}

}  // namespace

TEST_CASE("edge row: n screens that touch the line of sight leave 1 / (n + 1) of the field") {
    const std::array limits{0.001, 0.05, 0.3, 0.7, 1.2, 1.75};
    std::vector<RowCorner> corners;
    for (std::size_t n = 1; n <= limits.size(); ++n) {
        corners.push_back({static_cast<double>(n), 0, 0, n});
        for (std::size_t i = 0; i < n; ++i) corners[i].at = 3.0 * static_cast<double>(i + 1);
        const double lost = row_loss(corners, 3 * static_cast<double>(n + 1));
        CHECK(near(lost, 20 * std::log10(static_cast<double>(n) + 1), limits[n - 1]));
    }
    const EdgePair pair{5, 2, 5, 5 * 2.0 / 7 / 2 * 0.01, 5 * 2.0 / 7 / 2 * 0.04, false};
    CHECK(near(row_loss({{5, 0, 0.1, 0}, {7, 0, 0.2, 1}}, 12),
               -20 * std::log10(std::abs(pair_field(pair, wavelength))), 0.05));
}

TEST_CASE("edge row: in deep shadow the field is the product of the diffracted rays of the edges") {
    // A ray that turns by w at an edge has the coefficient 1 / (2 pi w) sqrt(lambda) there.
    const std::vector<RowCorner> corners{{4, 0, 0.9, 0}, {7, 0, 0.8, 1}, {12, 0, 0.9, 2}};
    double field = std::sqrt(20 / (4.0 * 3 * 5 * 8));
    for (const RowCorner& c : corners)
        field *= std::sqrt(wavelength) / (4 * std::numbers::pi * std::sin(c.bend / 2));
    CHECK(near(row_loss(corners, 20), -20 * std::log10(field), 1));
}

TEST_CASE(
    "edge row: the loss is continuous, and the same in both directions; a corner far below the "
    "line of sight hardly matters") {
    const std::vector<RowCorner> there{{3, 0, 0.2, 0}, {6, 0.1, 0, 1}, {8, 0, 0.05, 2}};
    const std::vector<RowCorner> back{{2, 0, 0.05, 2}, {4, 0.1, 0, 1}, {7, 0, 0.2, 0}};
    CHECK(near(row_loss(there, 10), row_loss(back, 10), 1e-9));
    CHECK(near(row_loss({{3, 0, 0.2, 0}, {6, 3, 0, 1}, {8, 0, 0.05, 2}}, 10),
               row_loss({{3, 0, 0.2, 0}, {8, 0, 0.05, 2}}, 10), 0.3));
    for (const double tiny : {1e-5, 1e-7})
        CHECK(near(row_loss({{3, 0, 0.2, 0}, {6, tiny, 0, 1}, {8, 0, 0.05, 2}}, 10),
                   row_loss({{3, 0, 0.2, 0}, {6, 0, tiny, 1}, {8, 0, 0.05, 2}}, 10), 0.15));
}

TEST_CASE(
    "edge pair: two edges 1 nm apart act as one; an edge far below the line of sight has no "
    "effect") {
    for (const double bend : {1e-4, 0.01, 0.1}) {
        const double along = 1e-9;
        // A turn by an angle w is shared: bends at both edges by w / 2 over the short face.
        const double w = std::sqrt(2 * bend * (1 / 5.0 + 1 / 5.0));
        const double each = w * w / 8 * along;
        const double nu = 2 * std::sqrt(bend / wavelength);
        CHECK(near(-20 * std::log10(std::abs(pair_field({5, along, 5, each, each}, wavelength))),
                   knife_edge_loss_db(nu), 0.1));
    }
    for (const double nu : {0.0, 0.5, 2.0}) {
        const double bend = nu * nu * wavelength / 4;
        const EdgePair pair{5, 2, 5, -9 * wavelength / 4, bend};
        const double rho = 5 / 7.0, sine = std::sqrt(1 - rho * rho);
        const double seen = (nu - rho * 3) / sine;  // against the straight line
        CHECK(near(-20 * std::log10(std::abs(pair_field(pair, wavelength))),
                   knife_edge_loss_db(seen), 0.01));
    }
}

TEST_CASE(
    "rays: behind an opaque block the loss is right within 1.2 dB (utd) or 2.5 dB (knife edges)") {
    for (const double width : {0.3, 0.6, 1.0, 2.0}) {
        const test::SoftBody exact(
            {{-width / 2, 0}, {width / 2, 0}, {width / 2, 1}, {-width / 2, 1}}, wavelength);
        for (const Material& material : {metal, Material{}}) {
            const Scene scene = drawn(block(-width / 2, 0, width / 2, 1), material);
            for (const auto by : both)
                for (const double y : {0.2, 0.5, 0.9}) {
                    const Rays model{.order = 0, .diffraction = by};
                    const Vec3 from{-8, 0.3}, to{8, y};
                    CAPTURE(width);
                    CAPTURE(y);
                    CAPTURE(static_cast<int>(by));
                    const bool lets_through = material.follows_model() && width < 0.5;
                    const double found = mean_excess(model, scene, from, to);
                    const double wave = exact.loss(from, around(to));
                    CAPTURE(found);
                    CAPTURE(wave);
                    // Powers of both sides have no fringes, which reach beyond 30 cm here.
                    const double fringes = by == RayDiffraction::knife_edge ? 2.5 : 1.2;
                    CHECK(near(found, wave, lets_through ? 3 : fringes));
                }
        }
    }
}

TEST_CASE("rays: deep behind a shelf, the difference from the exact loss is at most 2.5 dB") {
    for (const double thick : {0.3, 0.5}) {
        const test::SoftBody exact({{0, -1}, {thick, -1}, {thick, 1}, {0, 1}}, wavelength);
        const Scene scene = drawn(block(0, -1, thick, 1), metal);
        for (const auto by : both)
            for (const double y : {-2.0, -1.0, -0.5, 0.0, 1.0, 2.0}) {
                const Vec3 from{-2, 0.3}, to{2.5, y};
                CAPTURE(thick);
                CAPTURE(y);
                const double found = mean_excess({.order = 0, .diffraction = by}, scene, from, to);
                const double wave = exact.loss(from, around(to));
                CAPTURE(found);
                CAPTURE(wave);
                CHECK(near(found, wave, 2.5));
            }
    }
}

TEST_CASE(
    "rays: a path around the obstacle is found for a shelf, round and square pillars, and a "
    "container") {
    int number = 0;  // of the body; the seventh is a container
    const auto round = [](double x, double y) { return x * x + y * y < 0.09; };
    const auto slanting = [](double x, double y) {
        return std::abs(x + y) < 0.4 && std::abs(x - y) < 0.4;
    };
    for (const auto& inside : std::vector<std::function<bool(double, double)>>{
             block(-1.5, -0.25, 1.5, 0.25), block(-1.5, -0.05, 1.5, 0.05),
             block(-0.2, -0.2, 0.2, 0.2), block(-0.05, -0.05, 0.05, 0.05), round, slanting,
             block(-3, -1.25, 3, 1.25)}) {
        CAPTURE(number);
        ++number;
        const Scene scene = drawn(inside, metal);
        for (const auto by : both)
            for (double y = -1.5; y < 1.5; y += 0.013) {
                CAPTURE(y);
                const Vec3 from{-5, 0.02}, to{6, y};
                CHECK(loss({.order = 0, .diffraction = by}, scene, from, to) <
                      free_space_db(distance(from, to), f) + (number == 7 ? 75 : 36));
            }
    }
}

TEST_CASE("rays: the loss is continuous as an end of a link crosses the plane of a block's face") {
    const Scene wide = drawn(block(-1, 0, 1, 1.5), metal);
    for (const auto by : both) {
        const Rays model{.order = 0, .diffraction = by};
        CAPTURE(static_cast<int>(by));
        // Both ends along the face, one of them, and into the open.
        for (const double y : {-0.5, -0.001, 0.0, 0.001, 0.3})
            CHECK(largest_step(model, wide, {-7, y}, {7, -2}, {7, 0.7}) < 0.7);
    }
}

TEST_CASE("rays: a reflection from a face grows from 0 as the link leaves the plane of the face") {
    for (const double half : {1.0, 0.2}) {
        const Scene scene = drawn(block(-half, 0, half, 1.5), metal);
        for (const auto by : both)
            for (const double y : {-0.05, 0.0, 0.05}) {
                if (half < 1 && y != 0) continue;  // the mirror ends on the way
                CAPTURE(static_cast<int>(by));
                CHECK(largest_step({.order = 1, .diffraction = by}, scene, {-7, -y}, {7, y - 0.2},
                                   {7, y + 0.2}) < 0.7);
            }
    }
}

TEST_CASE(
    "rays: links 1 mm in front of and 1 mm behind the face of a block have nearly the same loss") {
    const Scene wide = drawn(block(-1, 0, 1, 1.5), metal);
    for (const auto by : both) {
        const Rays model{.order = 0, .diffraction = by};
        const double before = loss(model, wide, {-7, -0.001}, {7, -0.001});
        const double behind = loss(model, wide, {-7, 0.001}, {7, 0.001});
        CHECK(near(before, behind, 0.1));
        CHECK(near(before,
                   free_space_db(14, f) - 20 * std::log10(std::asin(6.0 / 8) / std::numbers::pi),
                   0.2));
    }
}

TEST_CASE("rays: the loss is continuous at the free end of a wall, with and without a material") {
    for (const auto wall : {ItuMaterial::brick, ItuMaterial::concrete, ItuMaterial::plasterboard})
        for (const Material& material : {Material{}, Material{.slab = wall, .thickness = 0.1_m}}) {
            const Scene scene = drawn(block(-0.05, -9, 0.05, 0), material);
            for (const auto by : both) {
                const Rays model{.order = 0, .diffraction = by, .wall = wall};
                CAPTURE(static_cast<int>(by));
                CAPTURE(static_cast<int>(wall));
                // Plasterboard turns the phase by half a wave: the border is a null of the field.
                const bool null = by == RayDiffraction::utd && wall == ItuMaterial::plasterboard;
                const double limit = null ? 1 : 0.1;
                CHECK(largest_step(model, scene, {-6, 2}, {6, -2.2}, {6, -1.8}) < limit);
                CHECK(largest_step(model, scene, {-6, 0}, {6, -0.2}, {6, 0.2}) < limit);
            }
        }
}

TEST_CASE("rays: a path goes around all shelves of a row, one after the other") {
    const auto shelves = [](double x, double y) {
        return std::abs(y) < 1 && x > -6 && x < 6 && std::fmod(x + 6, 3) < 0.9;
    };
    for (const auto by : both) {
        const Rays model{.order = 0, .diffraction = by};
        const double lost = loss(model, drawn(shelves, metal), {-8, 0.3}, {8, 0.1}) -
                            free_space_db(distance({-8, 0.3}, {8, 0.1}), f);
        CHECK(lost > 30);
        CHECK(lost < 70);
    }
}

TEST_CASE("rays: a path around shelves crosses a thin wall between them and pays its loss") {
    const auto shelf = [](double x, double y) {
        return std::abs(y) < 0.2 && std::abs(std::abs(x) - 3.5) < 0.45;
    };
    const auto wall = [](double x, double y) { return std::abs(x) < 0.05 && std::abs(y) < 5.5; };
    const auto both_of = [&](double x, double y) { return shelf(x, y) || wall(x, y); };
    const Vec3 from{-8, 0.05}, to{8, 0.02};
    for (const auto by : both) {
        const Rays model{.order = 0, .diffraction = by};
        const double through =
            loss(model, drawn(wall), from, to) - free_space_db(distance(from, to), f);
        const double shelves = loss(model, drawn(shelf), from, to);
        CHECK(shelves - free_space_db(distance(from, to), f) > 10);
        CHECK(std::abs(loss(model, drawn(both_of), from, to) - shelves - through) < 2);
    }
}

TEST_CASE(
    "rays: behind a row of shelves, the loss is continuous where a path begins to touch a shelf") {
    const auto shelves = [](double width) {
        return [=](double x, double y) {
            return y > -4 && y < 3 && x > -4 && x < 5 && std::fmod(x + 4, 3) < width;
        };
    };
    const Vec3 from{-8, 1.5}, first{4.5, -4.05}, last{4.5, -3.95};
    for (const double width : {0.2, 0.9})
        for (const Material& material :
             {Material{}, Material{.slab = ItuMaterial::concrete, .thickness = 0.2_m}, metal}) {
            const Scene scene = drawn(shelves(width), material);
            for (const auto by : both) {
                CAPTURE(width);
                CAPTURE(static_cast<int>(by));
                CHECK(largest_step({.order = 0, .diffraction = by}, scene, from, first, last) <
                      0.6);
            }
        }
}

TEST_CASE("rays: the loss is continuous at shadow borders of pillars and of oblique walls") {
    struct Case {
        std::function<bool(double, double)> inside;
        Material material;
        Vec3 from, first, last;
        double limit;
    };
    const auto bar = [](double x0, double y0, double x1, double y1, double width) {
        const double length = std::hypot(x1 - x0, y1 - y0);
        const double ux = (x1 - x0) / length, uy = (y1 - y0) / length;
        return [=](double x, double y) {
            const double along = (x - x0) * ux + (y - y0) * uy;
            const double off = (y - y0) * ux - (x - x0) * uy;
            return along > 0 && along < length && std::abs(off) < width / 2;
        };
    };
    const auto in_row = [](double x, double y) {
        return y > 0 && y < 0.4 && x > -4 && x < 2.4 && std::fmod(x + 4, 3) < 0.4;
    };
    const std::vector<Case> cases{
        {block(-1, 0, -0.8, 0.2), {}, {-7, -1}, {4, 0.5}, {4, 1.9}, 0.8},
        {block(-1, 0, 0, 1), {}, {-7, -1}, {4, 0.6}, {4, 3.8}, 0.8},
        {bar(-3, -3, 2, 2, 0.3), metal, {-3.1, 5.6}, {6.8, -5}, {6.8, 2}, 1},
        {bar(-3, -3, 2, 2, 0.3), {}, {-3.1, 5.6}, {6.8, -5}, {6.8, 2}, 1},
        {bar(-3, -3, 2, 0, 1), metal, {4, 2.7}, {-5.5, -4.8}, {-4, -4.8}, 3},
        {in_row, metal, {-8, -0.1}, {6, -2}, {6, 3}, 3.6},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Case& c = cases[i];
        const Scene scene = drawn(c.inside, c.material);
        for (const auto by : both) {
            CAPTURE(i);
            CAPTURE(static_cast<int>(by));
            CHECK(largest_step({.order = 0, .diffraction = by}, scene, c.from, c.first, c.last) <
                  c.limit);
        }
    }
}

TEST_CASE("rays: no loss exceeds that of free space by more than 200 dB") {
    const auto box = [](double x, double y) {
        return std::max(std::abs(x), std::abs(y)) < 2 && std::max(std::abs(x), std::abs(y)) > 1.8;
    };
    for (const auto by : {RayDiffraction::none, RayDiffraction::knife_edge, RayDiffraction::utd})
        for (const Material& material :
             {metal, Material{}, Material{.per_metre = DbPerMeter{1e6}}}) {
            const Scene scene = drawn(box, material);
            for (const Vec3 to : {Vec3{8, 0}, Vec3{1.9, 0}, Vec3{1.9, 1.9}})
                CHECK(loss({.diffraction = by, .wall = ItuMaterial::metal}, scene, {0.1, 0.2}, to) <
                      free_space_db(distance({0.1, 0.2}, to), f) + 200.001);
        }
}

TEST_CASE("rays: a wall without a given material counts as at most half a metre thick") {
    const Rays straight{.order = 0, .diffraction = RayDiffraction::none};
    for (const double thick : {0.4, 0.5, 0.9, 3.0})
        CHECK(near(
            loss(straight, drawn(block(0, -6, thick, 6)), {-2, 0}, {5, 0}),
            free_space_db(7, f) + slab_loss(ItuMaterial::concrete, {std::min(thick, 0.5)}, f).value,
            1e-6));
    const Material given{.slab = ItuMaterial::concrete, .thickness = 0.9_m};
    CHECK(near(loss(straight, drawn(block(0, -6, 0.1, 6), given), {-2, 0}, {5, 0}),
               free_space_db(7, f) + slab_loss(ItuMaterial::concrete, 0.9_m, f).value, 1e-6));
}

}  // namespace ray_bodies_test
