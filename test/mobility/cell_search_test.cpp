// SPDX-License-Identifier: MIT
#include "mobility/cell_search.hpp"

#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cell_search_test {
using namespace rovernet;
using test::drawn_map;

namespace {

// [m] Some hundred steps, each of which may pass over a billionth of a cell.
constexpr double rounding = 1e-6;

/// A map with what a search asks of it.
struct Ground {
    Scene scene;
    int columns = scene.grid().columns;
    FreeSpace space;
    CellNorm norm{scene.frame()};
    CellSearch search{scene.frame(), columns};

    Ground(const OccupancyGrid& grid, Meters radius) : scene(grid), space(scene, radius) {}

    CellPoint centre(int cell) const { return {cell % columns + 0.5, cell / columns + 0.5}; }
    int cell(int column, int row) const { return row * columns + column; }
    /// An end in the middle of a cell.
    PathEnd end(int column, int row) const {
        return {{column + 0.5, row + 0.5}, {{cell(column, row), 0}}};
    }
    /// An end anywhere, with ways to the free cells around it.
    PathEnd end(CellPoint at) const {
        PathEnd end{at, {}};
        for (int row = 0; row < scene.grid().rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const int c = cell(column, row);
                if (std::abs(column + 0.5 - at.u) > 1.5 || std::abs(row + 0.5 - at.v) > 1.5)
                    continue;
                if (space.free[static_cast<std::size_t>(c)])
                    end.ways.push_back({c, norm(at, centre(c))});
            }
        return end;
    }
    std::vector<int> way(const PathEnd& from, const PathEnd& to) {
        return search.shortest_way(space.steps, from, to);
    }
};

double access_length(const PathEnd& end, int cell) {
    const auto found = std::find_if(end.ways.begin(), end.ways.end(),
                                    [&](const auto& way) { return way.cell == cell; });
    REQUIRE(found != end.ways.end());
    return found->length;
}

/// Of a way that takes only steps that are allowed [m].
double length_of(const Ground& ground, const PathEnd& from, const PathEnd& to,
                 const std::vector<int>& way) {
    double sum = access_length(from, way.front()) + access_length(to, way.back());
    for (std::size_t i = 1; i < way.size(); ++i) {
        const CellPoint a = ground.centre(way[i - 1]), b = ground.centre(way[i]);
        const auto step = std::find_if(cell_steps.begin(), cell_steps.end(), [&](CellStep s) {
            return s.column == b.u - a.u && s.row == b.v - a.v;
        });
        REQUIRE(step != cell_steps.end());
        const auto allowed = ground.space.steps[static_cast<std::size_t>(way[i - 1])];
        REQUIRE((allowed >> (step - cell_steps.begin()) & 1) == 1);
        sum += ground.norm(a, b);
    }
    return sum;
}

/// The map as a graph for Boost.
class Oracle {
  public:
    explicit Oracle(const Ground& ground) : graph_(ground.space.steps.size() + 2) {
        for (std::size_t from = 0; from < ground.space.steps.size(); ++from)
            for (std::size_t d = 0; d < cell_steps.size(); ++d) {
                if (!(ground.space.steps[from] >> d & 1)) continue;
                const int cell = static_cast<int>(from);
                const int to = cell + ground.cell(cell_steps[d].column, cell_steps[d].row);
                add_edge(from, static_cast<std::size_t>(to),
                         ground.norm(ground.centre(cell), ground.centre(to)), graph_);
            }
    }
    /// Of the shortest way between the ends [m]; infinite if there is none.
    double shortest(const PathEnd& from, const PathEnd& to) {
        const std::size_t start = num_vertices(graph_) - 2;
        for (const auto& [cell, length] : from.ways)
            add_edge(start, static_cast<std::size_t>(cell), length, graph_);
        std::vector<double> distance(num_vertices(graph_));
        dijkstra_shortest_paths(graph_, start,
                                boost::distance_map(distance.data())
                                    .distance_inf(std::numeric_limits<double>::infinity()));
        clear_vertex(start, graph_);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [cell, length] : to.ways)
            least = std::min(least, distance[static_cast<std::size_t>(cell)] + length);
        return least;
    }

  private:
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property,
                          boost::property<boost::edge_weight_t, double>>
        graph_;
};

/// Ways between random ends on random maps are as long as Boost's; returns how many there are.
int compare_with_boost(double cell_width, double cell_height, std::uint32_t seed) {
    test::Draw draw(seed);
    int found = 0;
    for (int trial = 0; trial < 12; ++trial) {
        OccupancyGrid grid = test::random_map(draw, 40, 25, 5 + draw.below(25));
        grid.cell_width = cell_width;
        grid.cell_height = cell_height;
        Ground ground(grid, 0_m);
        Oracle oracle(ground);
        for (int i = 0; i < 20; ++i) {
            const PathEnd from = ground.end({draw.uniform(0, 40), draw.uniform(0, 25)});
            const PathEnd to = ground.end({draw.uniform(0, 40), draw.uniform(0, 25)});
            const double expected = oracle.shortest(from, to);
            const auto way = ground.way(from, to);
            REQUIRE(way.empty() == std::isinf(expected));
            if (way.empty()) continue;
            ++found;
            REQUIRE(std::abs(length_of(ground, from, to, way) - expected) < rounding);
        }
    }
    return found;
}

}  // namespace

TEST_CASE("cell search: paths over random maps are as long as those by Boost's Dijkstra search") {
    CHECK(compare_with_boost(1, 1, 41) > 100);
    CHECK(compare_with_boost(0.05, 0.08, 42) > 100);
}

TEST_CASE("cell search: paths are shortest also in cells a hundred times as long as wide") {
    CHECK(compare_with_boost(0.01, 1, 43) > 100);
    CHECK(compare_with_boost(1, 0.01, 44) > 100);
}

TEST_CASE("cell search: the path around a wall goes up, across and down") {
    Ground ground(drawn_map({".......", "...#...", "...#...", "...#..."}), 0_m);
    const PathEnd from = ground.end(1, 0), to = ground.end(5, 0);
    const auto way = ground.way(from, to);
    REQUIRE(way.size() == 9);
    // To the cell beside the wall's upper end diagonally, and no corner is cut.
    CHECK(std::abs(length_of(ground, from, to, way) - (6 + 2 * std::sqrt(2.0))) < rounding);
}

TEST_CASE("cell search: of equally long paths, one close to the straight line is returned") {
    Ground ground(drawn_map(std::vector<std::string>(40, std::string(60, '.'))), 0_m);
    for (const auto& [column, row] : {std::pair{55, 20}, {20, 38}, {59, 1}, {30, 30}}) {
        for (const bool forth : {true, false}) {
            const PathEnd near = ground.end(0, 0), far = ground.end(column, row);
            const auto way = forth ? ground.way(near, far) : ground.way(far, near);
            for (const int cell : way) {
                const CellPoint p = ground.centre(cell);
                const double aside = std::abs((p.u - 0.5) * row - (p.v - 0.5) * column) /
                                     std::sqrt(1.0 * row * row + column * column);
                // Of two cells beside each other one is at most half a cell's diagonal off.
                CHECK(aside < std::sqrt(0.5) + rounding);
            }
        }
    }
}

TEST_CASE("cell search: a path does not depend on earlier searches") {
    test::Draw draw(45);
    Ground ground(test::random_map(draw, 60, 60, 15), 0_m);
    for (int i = 0; i < 50; ++i) {
        const PathEnd from = ground.end({draw.uniform(0, 60), draw.uniform(0, 60)});
        const PathEnd to = ground.end({draw.uniform(0, 60), draw.uniform(0, 60)});
        CellSearch fresh(ground.scene.frame(), ground.columns);
        REQUIRE(ground.way(from, to) == fresh.shortest_way(ground.space.steps, from, to));
    }
}

TEST_CASE("cell search: there is no path from or to outside the map, or through a wall") {
    Ground ground(drawn_map({"..#..", "..#.."}), 0_m);
    CHECK(ground.way(ground.end(0, 0), ground.end(4, 0)).empty());
    CHECK(ground.way(ground.end(0, 0), {{4, 1}, {}}).empty());
    CHECK(ground.way({{0, 1}, {}}, ground.end(4, 0)).empty());
    CHECK(ground.way(ground.end(0, 0), ground.end(0, 0)) == std::vector{0});
}

}  // namespace cell_search_test
