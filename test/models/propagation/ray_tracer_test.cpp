// SPDX-License-Identifier: MIT
#include "models/propagation/ray_tracer.hpp"

#include "sim/complex_math.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace ray_tracer_test {
using namespace rovernet;
using test::near;

namespace {

constexpr double pi = std::numbers::pi;

/// Walls one cell thick around a free room or beside a free lane, whose lower left corner is (0,
/// 0).
Scene hollow(double width, double depth, double cell, bool ends = true) {
    OccupancyGrid grid;
    grid.columns = static_cast<int>(std::lround(width / cell)) + 2;
    grid.rows = static_cast<int>(std::lround(depth / cell)) + 2;
    grid.cell_width = grid.cell_height = cell;
    grid.origin = {-cell, -cell};
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const bool side = row == 0 || row + 1 == grid.rows;
            const bool end = column == 0 || column + 1 == grid.columns;
            grid.cells.push_back(side || (ends && end) ? Cell::occupied : Cell::free);
        }
    return Scene(grid);
}

/// Sums of the paths of a link, each reflection with one coefficient.
struct ScalarSum {
    double coefficient, wave_number;
    math::Complex field = 0;
    double power = 0;
    int paths = 0;

    /// @param weight  of all of them, besides
    void add(RayTracer& tracer, Vec3 to, double weight = 1) {
        RayPaths found;
        tracer.trace(to, nullptr, found);
        for (const RayPath& path : found.paths) {
            double factor = weight / path.length;
            for (const RayHit& hit : found.hits(path)) {
                CHECK(hit.kind == RayHit::Kind::reflection);
                factor *= coefficient;
            }
            const double turns = path.length * wave_number / (2 * pi);
            field += factor * math::phasor(-2 * pi * (turns - std::floor(turns)));
            power += factor * factor;
            ++paths;
        }
    }
    double coherent_db(double f) const { return loss(std::sqrt(std::norm(field)), f); }
    double incoherent_db(double f) const { return loss(std::sqrt(power), f); }
    static double loss(double amplitude, double f) {
        return -20 * std::log10(speed_of_light / f / (4 * pi) * amplitude);
    }
};

std::array<double, 3> three(std::string text) {
    std::replace(text.begin(), text.end(), 'x', ' ');
    std::istringstream in(text);
    std::array<double, 3> v{};
    in >> v[0] >> v[1] >> v[2];
    return v;
}

double reflections(const RayPaths& paths, const RayPath& path) {
    const auto hits = paths.hits(path);
    return static_cast<double>(std::count_if(hits.begin(), hits.end(), [](const RayHit& hit) {
        return hit.kind == RayHit::Kind::reflection;
    }));
}

}  // namespace

TEST_CASE("ray tracer: number and strength of the images of a room equal the test vectors") {
    // The tracer plans in plan: floor and ceiling enter as receivers mirrored in them.
    const test::Vectors vectors("room_images.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const int order = static_cast<int>(vectors.number(i, "order_N"));
        if (order > 6) continue;  // more images, but no other code
        const auto room = three(vectors.text(i, "room_m"));
        const auto tx = three(vectors.text(i, "tx")), rx = three(vectors.text(i, "rx"));
        const double f = vectors.number(i, "f_Hz"), gamma = vectors.number(i, "Gamma_scalar");
        const Scene scene = hollow(room[0], room[1], 0.5);
        ScalarSum sum{gamma, 2 * pi * f / speed_of_light};
        for (int m = -order; m <= order; ++m) {
            const double z = m % 2 == 0 ? m * room[2] + rx[2] : (m + 1) * room[2] - rx[2];
            RayTracer tracer(scene, {tx[0], tx[1], tx[2]}, order - std::abs(m), 0.1);
            sum.add(tracer, {rx[0], rx[1], z}, std::pow(gamma, std::abs(m)));
        }
        CAPTURE(i);
        CHECK(sum.paths == static_cast<int>(vectors.number(i, "n_images")));
        CHECK(near(sum.coherent_db(f), vectors.number(i, "PL_coherent_dB"), 1e-8));
        CHECK(near(sum.incoherent_db(f), vectors.number(i, "PL_incoherent_dB"), 1e-9));
        ++compared;
    }
    CHECK(compared >= 50);
}

TEST_CASE(
    "ray tracer: in a corridor of lossy walls, reflections up to each order equal the image "
    "series") {
    const test::Vectors vectors("corridor_lossy_images.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double a = vectors.number(i, "a_m"), rho = vectors.number(i, "rho_m");
        const double f = vectors.number(i, "f_Hz");
        const Scene scene = hollow(rho + 1, a, a / 5, false);
        for (const int order : {0, 1, 2, 3, 5, 10, 20}) {
            RayTracer tracer(scene, {0.5, 0.7}, order, 0.1);
            ScalarSum sum{vectors.number(i, "Gamma"), 2 * pi * f / speed_of_light};
            sum.add(tracer, {0.5 + rho, 1.3});
            CAPTURE(order);
            CAPTURE(rho);
            CHECK(sum.paths == 2 * order + 1);
            const double expected = vectors.number(i, "PL_coherent_converged_dB") +
                                    vectors.number(i, "err_N" + std::to_string(order) + "_dB");
            CHECK(near(sum.coherent_db(f), expected, 1e-7));
            if (order == 20 && std::abs(vectors.number(i, "Gamma")) < 0.8)
                CHECK(near(sum.incoherent_db(f), vectors.number(i, "PL_incoherent_dB"), 1e-3));
        }
    }
}

TEST_CASE("ray tracer: in a metal corridor, reflections up to each order equal the image series") {
    const test::Vectors vectors("corridor_pec_modal_vs_images.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double a = vectors.number(i, "a_m"), rho = vectors.number(i, "rho_m");
        const double f = vectors.number(i, "f_Hz");
        const Scene scene = hollow(rho + 1, a, a / 5, false);
        for (const int order : {0, 1, 3, 10, 100}) {
            if (order == 100 && i > 0) continue;
            RayTracer tracer(scene, {0.5, vectors.number(i, "y_tx")}, order, 0.1);
            ScalarSum sum{-1, 2 * pi * f / speed_of_light};
            sum.add(tracer, {0.5 + rho, vectors.number(i, "y_rx")});
            CAPTURE(order);
            CAPTURE(rho);
            CHECK(near(sum.coherent_db(f), vectors.number(i, "PL_images_N" + std::to_string(order)),
                       1e-7));
        }
    }
}

TEST_CASE(
    "ray tracer: a wall drawn on the grid at any angle reflects like a smooth wall at this angle") {
    for (int degrees = 0; degrees < 180; degrees += 7) {
        CAPTURE(degrees);
        const double angle = degrees * pi / 180, cell = 0.05;
        const Vec3 along{std::cos(angle), std::sin(angle)}, out{along.y, -along.x};
        OccupancyGrid grid;
        grid.columns = grid.rows = 400;
        grid.cell_width = grid.cell_height = cell;
        grid.origin = {-10, -10};
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const Vec3 p{(column + 0.5) * cell - 10, (row + 0.5) * cell - 10};
                const bool wall =
                    std::abs(dot(p, along)) < 4 && std::abs(dot(p, out) + 0.15) < 0.15;
                grid.cells.push_back(wall ? Cell::occupied : Cell::free);
            }
        const Scene scene(grid);
        const Vec3 from = 3 * out - 2 * along, to = 2 * out + 3 * along;
        RayTracer tracer(scene, from, 1, 0.12);
        RayPaths paths;
        tracer.trace(to, nullptr, paths);
        REQUIRE(paths.paths.size() == 2);
        CHECK(paths.hits(paths.paths[0]).empty());
        REQUIRE(paths.hits(paths.paths[1]).size() == 1);  // no step of the wall is in its way
        CHECK(near(paths.paths[1].length, std::sqrt(50), 0.05));
        const RayHit& hit = paths.hits(paths.paths[1])[0];
        CHECK(near(hit.cosine, 5 / std::sqrt(50), 0.005));
        CHECK(near(hit.thickness, 0.3, 0.03));
    }
}

TEST_CASE(
    "ray tracer: a path along an oblique wall does not cross the stair steps of the wall's cells") {
    OccupancyGrid grid;
    grid.columns = grid.rows = 200;
    grid.cell_width = grid.cell_height = 0.05;
    const Vec3 along{std::cos(0.4), std::sin(0.4)}, out{along.y, -along.x};
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const Vec3 p{(column + 0.5) * 0.05 - 5, (row + 0.5) * 0.05 - 5};
            grid.cells.push_back(std::abs(dot(p, along)) < 4 && std::abs(dot(p, out)) < 0.2
                                     ? Cell::occupied
                                     : Cell::free);
        }
    const Scene scene(grid);
    const Vec3 middle{5, 5};
    for (double off = 0.2; off < 0.3; off += 0.007) {
        RayTracer tracer(scene, middle - 3 * along + off * out, 0, 0.12);
        RayPaths paths;
        tracer.trace(middle + 3 * along + off * out, nullptr, paths);
        CHECK(paths.hits(paths.paths[0]).empty());
    }
    // Through it the wall is as thick as it was drawn, wherever the path crosses it.
    for (double at = -3; at < 3; at += 0.13) {
        RayTracer tracer(scene, middle + at * along + 2 * out, 0, 0.12);
        RayPaths paths;
        tracer.trace(middle + (at + 0.7) * along - 2 * out, nullptr, paths);
        REQUIRE(paths.hits(paths.paths[0]).size() == 1);
        CHECK(near(paths.hits(paths.paths[0])[0].thickness, 0.4, 0.03));
        CHECK(near(paths.hits(paths.paths[0])[0].cosine, 4 / std::sqrt(16.49), 0.003));
    }
}

TEST_CASE(
    "ray tracer: reflected paths between perpendicular walls have the lengths of the closed form") {
    const Scene scene = hollow(8, 6, 0.5);
    const Vec3 a{1.2, 2.1, 1}, b{6.3, 4.4, 2.5};
    RayTracer tracer(scene, a, 2, 0.1);
    RayPaths paths;
    tracer.trace(b, nullptr, paths);
    std::vector<double> found, expected;
    for (const RayPath& p : paths.paths) found.push_back(p.length);
    for (int m = -2; m <= 2; ++m)
        for (int n = -2; n <= 2; ++n) {
            if (std::abs(m) + std::abs(n) > 2) continue;
            const double x = m % 2 == 0 ? m * 8 + b.x : (m + 1) * 8 - b.x;
            const double y = n % 2 == 0 ? n * 6 + b.y : (n + 1) * 6 - b.y;
            expected.push_back(distance(a, {x, y, b.z}));
        }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(near(found[i], expected[i], 1e-12));
}

TEST_CASE("ray tracer: a face reflects only within its ends, horizontally and in height") {
    OccupancyGrid grid = test::drawn_map({"......", ".####.", "......", "......", "......"});
    const Scene scene(grid, {Material{.height = 2_m}});
    const auto count = [&](Vec3 from, Vec3 to) {
        RayTracer tracer(scene, from, 1, 0.1);
        RayPaths paths;
        tracer.trace(to, nullptr, paths);
        return paths.paths.size() - 1;
    };
    CHECK(count({1.5, 1}, {4.5, 1}) == 1);
    CHECK(count({0.5, 1}, {1.4, 1}) == 0);  // the mirror is at x = 1 to 5, the point at 0.95
    CHECK(count({0.5, 1}, {1.6, 1}) == 1);
    CHECK(count({1.5, 1, 1}, {4.5, 1, 2.9}) == 1);
    CHECK(count({1.5, 1, 1}, {4.5, 1, 3.1}) == 0);
    CHECK(count({1.5, 1}, {4.5, 3.5}) == 0);  // behind the wall
}

TEST_CASE(
    "ray tracer: from both ends of a link the same paths are found, with and without a loss "
    "limit") {
    test::Draw draw(11);
    const Scene scene(test::random_map(draw, 30, 30, 6));
    const RayMaterials materials(scene.materials(), 2450_MHz, ItuMaterial::concrete, {}, 6_dB);
    const RayLimit limit{materials, 2450_MHz, 40};
    std::size_t seen = 0;
    for (int i = 0; i < 40; ++i) {
        const auto place = [&] {
            return Vec3{draw.uniform(-5, 35), draw.uniform(-5, 35), draw.uniform(0, 3)};
        };
        const Vec3 a = place(), b = place();
        for (const RayLimit* used : {static_cast<const RayLimit*>(nullptr), &limit}) {
            RayTracer there(scene, a, 2, 0.1), back(scene, b, 2, 0.1);
            RayPaths p, q;
            there.trace(b, used, p);
            back.trace(a, used, q);
            REQUIRE(p.paths.size() == q.paths.size());
            for (std::size_t k = 0; k < p.paths.size(); ++k) {
                CHECK(p.paths[k].length == q.paths[k].length);
                CHECK(reflections(p, p.paths[k]) == reflections(q, q.paths[k]));
                if (used) CHECK(there.losses()[k] == back.losses()[k]);
                seen += p.paths[k].hits;
            }
        }
    }
    CHECK(seen > 300);
}

TEST_CASE("ray tracer: the mode for few receivers finds the same paths as the normal mode") {
    test::Draw draw(12);
    const Scene scene(test::random_map(draw, 30, 30, 6));
    std::size_t reflected = 0;
    for (int i = 0; i < 40; ++i) {
        const auto place = [&] {
            return Vec3{draw.uniform(-5, 35), draw.uniform(-5, 35), draw.uniform(0, 3)};
        };
        const Vec3 from = place(), to = place();
        for (const int order : {1, 2, 3}) {
            if (order == 3 && i >= 4) continue;  // it takes its time
            RayTracer many(scene, from, order, 0.1), few(scene, from, order, 0.1, false, true);
            RayPaths p, q;
            few.trace(place(), nullptr, q);
            many.trace(to, nullptr, p);
            few.trace(to, nullptr, q);
            REQUIRE(p.paths.size() == q.paths.size());
            for (std::size_t k = 0; k < p.paths.size(); ++k)
                CHECK(p.paths[k].length == q.paths[k].length);
            reflected += p.paths.size() - 1;
        }
    }
    CHECK(reflected > 100);
}

}  // namespace ray_tracer_test
