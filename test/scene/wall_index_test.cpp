// SPDX-License-Identifier: MIT
#include "scene/wall_index.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace wall_index_test {
using namespace rovernet;

namespace {

/// Oracle and code round differently: a few units in the last place of 100-cell coordinates, and
/// crossings or gaps shorter than cell_tolerance may be told apart differently.
constexpr double tolerance = 4e-9;  // [cells]

using Interval = std::pair<long double, long double>;

/// Slow and plain: every occupied cell on its own, clipped in long double, then joined.
/// Along a grid line a cell counts if the cell across the line is occupied as well.
std::vector<Interval> by_cells(const OccupancyGrid& grid, CellPoint a, CellPoint b) {
    const auto occupied = [&](int i, int j) {
        return i >= 0 && i < grid.columns && j >= 0 && j < grid.rows &&
               grid.at(i, j) == Cell::occupied;
    };
    std::vector<Interval> pieces;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            long double from = 0, to = 1;
            const auto clip = [&](long double start, long double step, int low) {
                if (step == 0) {
                    if (start < low || start > low + 1) to = -1;
                    return;
                }
                const long double s = (low - start) / step, t = (low + 1 - start) / step;
                from = std::max(from, std::min(s, t));
                to = std::min(to, std::max(s, t));
            };
            clip(a.u, static_cast<long double>(b.u) - a.u, i);
            clip(a.v, static_cast<long double>(b.v) - a.v, j);
            bool in = occupied(i, j);
            if (a.u == b.u && a.u == i) in = in && occupied(i - 1, j);
            if (a.u == b.u && a.u == i + 1) in = in && occupied(i + 1, j);
            if (a.v == b.v && a.v == j) in = in && occupied(i, j - 1);
            if (a.v == b.v && a.v == j + 1) in = in && occupied(i, j + 1);
            if (in && from < to) pieces.push_back({from, to});
        }
    std::sort(pieces.begin(), pieces.end());
    const long double shortest = cell_tolerance / std::hypot(b.u - a.u, b.v - a.v);
    std::vector<Interval> joined;
    for (const Interval& p : pieces) {
        if (!joined.empty() && p.first - joined.back().second <= shortest)
            joined.back().second = std::max(joined.back().second, p.second);
        else
            joined.push_back(p);
    }
    std::erase_if(joined, [&](const Interval& p) { return p.second - p.first <= shortest; });
    return joined;
}

/// Every rectangle against the segment with the index's own formula, without tiles.
std::vector<Crossing> by_rectangles(const std::vector<CellRectangle>& rectangles, CellPoint a,
                                    CellPoint b) {
    struct Piece {
        double from, to;
    };
    const double x = 1 / (b.u - a.u), y = 1 / (b.v - a.v);
    std::vector<Piece> pieces;
    for (const CellRectangle& r : rectangles) {
        const double x0 = (r.column0 - a.u) * x, x1 = (r.column1 - a.u) * x;
        const double y0 = (r.row0 - a.v) * y, y1 = (r.row1 - a.v) * y;
        const Piece piece{std::max({0.0, std::min(x0, x1), std::min(y0, y1)}),
                          std::min({1.0, std::max(x0, x1), std::max(y0, y1)})};
        if (piece.from < piece.to) pieces.push_back(piece);
    }
    std::sort(pieces.begin(), pieces.end(),
              [](const Piece& p, const Piece& q) { return p.from < q.from; });
    const double du = b.u - a.u, dv = b.v - a.v;
    const double shortest = cell_tolerance / std::sqrt(du * du + dv * dv);
    std::vector<Crossing> out;
    for (const Piece& p : pieces) {
        if (!out.empty() && p.from - out.back().exit <= shortest)
            out.back().exit = std::max(out.back().exit, p.to);
        else
            out.push_back({p.from, p.to, 0});
    }
    std::erase_if(out, [&](const Crossing& c) { return c.exit - c.entry <= shortest; });
    for (Crossing& c : out) c.length = c.exit - c.entry;
    return out;
}

std::vector<CellRectangle> one_by_one(const OccupancyGrid& grid) {
    std::vector<CellRectangle> cells;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i)
            if (grid.at(i, j) == Cell::occupied) cells.push_back({i, j, i + 1, j + 1});
    return cells;
}

WallIndex index_of(const OccupancyGrid& grid) {
    return {grid.columns, grid.rows, solid_rectangles(grid, Solid::walls)};
}

/// A point in or around the map: anywhere, on grid lines, or on a vertex.
CellPoint random_point(test::Draw& draw, const OccupancyGrid& grid) {
    CellPoint p{draw.uniform(-5, grid.columns + 5), draw.uniform(-5, grid.rows + 5)};
    const int kind = draw.below(6);
    if (kind == 0 || kind == 2) p.u = std::floor(p.u);
    if (kind == 1 || kind == 2) p.v = std::floor(p.v);
    if (kind == 3) p = {std::floor(p.u) + 0.5, std::floor(p.v) + 0.25};
    return p;
}

struct Ray {
    CellPoint a, b;
};

/// Rays of every kind: free, axis-parallel, along grid lines, through vertices.
Ray random_ray(test::Draw& draw, const OccupancyGrid& grid) {
    Ray ray{random_point(draw, grid), random_point(draw, grid)};
    const int kind = draw.below(8);
    if (kind == 0) ray.b.u = ray.a.u;
    if (kind == 1) ray.b.v = ray.a.v;
    if (kind == 2) ray.b.v = ray.a.v + (ray.b.u - ray.a.u);
    if (kind == 3) ray.b.v = ray.a.v - (ray.b.u - ray.a.u);
    if (kind == 4) {  // aimed exactly at a vertex, as far beyond it
        const CellPoint vertex{draw.below(grid.columns + 1) + 0.0, draw.below(grid.rows + 1) + 0.0};
        ray.b = {2 * vertex.u - ray.a.u, 2 * vertex.v - ray.a.v};
    }
    return ray;
}

struct World {
    OccupancyGrid grid;
    WallIndex index;  ///< of large rectangles
    WallIndex cells;  ///< of one rectangle per cell
};

template <class Check>
void for_random_rays(std::uint32_t seed, Check check) {
    test::Draw draw(seed);
    for (int map = 0; map < 40; ++map) {
        const OccupancyGrid grid = test::random_map(draw, 1 + draw.below(180), 1 + draw.below(180),
                                                    map % 4 == 0 ? 60 : draw.below(15));
        const World world{grid, index_of(grid), {grid.columns, grid.rows, one_by_one(grid)}};
        for (int i = 0; i < 150; ++i) check(world, random_ray(draw, grid), draw);
    }
}

double length_of(const Ray& r) { return std::hypot(r.b.u - r.a.u, r.b.v - r.a.v); }

}  // namespace

TEST_CASE("wall index: crossings equal those found by testing all occupied cells one by one") {
    for_random_rays(11, [](const World& world, const Ray& ray, test::Draw&) {
        const double length = length_of(ray);
        if (length < 1e-6) return;
        const auto expected = by_cells(world.grid, ray.a, ray.b);
        std::vector<Crossing> found;
        world.index.crossings(ray.a, ray.b, length, found);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            REQUIRE(std::abs(found[i].entry - double(expected[i].first) * length) < tolerance);
            REQUIRE(std::abs(found[i].exit - double(expected[i].second) * length) < tolerance);
        }
    });
}

TEST_CASE(
    "wall index: searching walls by tiles gives the same crossings, bit for bit, as testing every "
    "rectangle") {
    for_random_rays(12, [](const World& world, Ray ray, test::Draw&) {
        if (std::pair(ray.b.u, ray.b.v) < std::pair(ray.a.u, ray.a.v)) std::swap(ray.a, ray.b);
        if (ray.a.u == ray.b.u || ray.a.v == ray.b.v) return;  // on grid lines: see the cells test
        std::vector<Crossing> found;
        world.index.crossings(ray.a, ray.b, 1, found);
        REQUIRE(found == by_rectangles(solid_rectangles(world.grid, Solid::walls), ray.a, ray.b));
    });
}

TEST_CASE("wall index: all walls are found for a ray from far away through corners of tiles") {
    test::Draw draw(17);
    const OccupancyGrid grid = test::random_map(draw, 200, 200, 50);
    const WallIndex index = index_of(grid);
    const auto rectangles = solid_rectangles(grid, Solid::walls);
    for (int i = 0; i < 6000; ++i) {
        const double far = i % 2 == 0 ? 1e9 : 1e6;
        const double line = WallIndex::tile_size * draw.below(4);
        const double edge = draw.below(2) * 200.0;
        const CellPoint corner = i % 3 == 0 ? CellPoint{edge, line} : CellPoint{line, edge};
        const double du = draw.uniform(0.1, 1), dv = draw.uniform(-1, 1);
        const CellPoint a{corner.u - far * du, corner.v - far * dv};
        const double beyond = far * draw.uniform(0.2, 1);
        const CellPoint b{corner.u + beyond * du, corner.v + beyond * dv};
        std::vector<Crossing> found;
        index.crossings(a, b, 1, found);
        REQUIRE(found == by_rectangles(rectangles, a, b));
    }
}

TEST_CASE(
    "wall index: crossings do not depend on how the occupied cells are divided into rectangles") {
    for_random_rays(13, [](const World& world, const Ray& ray, test::Draw&) {
        std::vector<Crossing> whole, cut;
        world.index.crossings(ray.a, ray.b, length_of(ray), whole);
        world.cells.crossings(ray.a, ray.b, length_of(ray), cut);
        REQUIRE(whole == cut);
    });
}

TEST_CASE(
    "wall index: a ray and its reverse give mirrored crossings of equal lengths, bit for bit") {
    for_random_rays(14, [](const World& world, const Ray& ray, test::Draw&) {
        const double length = length_of(ray);
        std::vector<Crossing> forth, back;
        world.index.crossings(ray.a, ray.b, length, forth);
        world.index.crossings(ray.b, ray.a, length, back);
        REQUIRE(forth.size() == back.size());
        for (std::size_t i = 0; i < forth.size(); ++i) {
            const Crossing& mirror = back[back.size() - 1 - i];
            REQUIRE(forth[i].length == mirror.length);
            REQUIRE(std::abs(forth[i].entry - (length - mirror.exit)) < tolerance);
            REQUIRE(std::abs(forth[i].exit - (length - mirror.entry)) < tolerance);
        }
        const double all = std::numeric_limits<double>::infinity();
        REQUIRE(world.index.solid_length(ray.a, ray.b, length, all) ==
                world.index.solid_length(ray.b, ray.a, length, all));
    });
}

TEST_CASE(
    "wall index: the length inside walls is exact up to a given limit; a larger result is a lower "
    "bound") {
    for_random_rays(15, [](const World& world, const Ray& ray, test::Draw& draw) {
        const double all = std::numeric_limits<double>::infinity();
        const double exact = world.index.solid_length(ray.a, ray.b, length_of(ray), all);
        const double enough = draw.uniform(0, 20);
        const double found = world.index.solid_length(ray.a, ray.b, length_of(ray), enough);
        if (exact <= enough)
            REQUIRE(found == exact);
        else
            REQUIRE(found > enough);
        REQUIRE(found <= exact);
    });
}

TEST_CASE(
    "wall index: the length of a ray inside walls is the sum of the lengths of its crossings") {
    for_random_rays(16, [](const World& world, const Ray& ray, test::Draw&) {
        if (ray.a == ray.b) return;
        std::vector<Crossing> found;
        world.index.crossings(ray.a, ray.b, length_of(ray), found);
        double sum = 0;
        for (const Crossing& c : found) {
            REQUIRE(c.length > 0);
            REQUIRE(std::abs(c.exit - c.entry - c.length) < tolerance);
            sum += c.length;
        }
        const double all = std::numeric_limits<double>::infinity();
        const double total = world.index.solid_length(ray.a, ray.b, length_of(ray), all);
        REQUIRE(std::abs(total - sum) < tolerance);
    });
}

TEST_CASE(
    "wall index: adding an outer border of free cells to a map does not change the crossings") {
    const OccupancyGrid tight = test::drawn_map({"##", "##"});
    const OccupancyGrid wide = test::drawn_map({"....", ".##.", ".##.", "...."});
    std::vector<Crossing> inner, outer;
    index_of(tight).crossings({-1, 0.25}, {3, 1.75}, 1, inner);
    index_of(wide).crossings({0, 1.25}, {4, 2.75}, 1, outer);
    CHECK(inner == outer);
}

}  // namespace wall_index_test
