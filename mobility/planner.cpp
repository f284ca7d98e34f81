// SPDX-License-Identifier: MIT
#include "mobility/planner.hpp"

#include <boost/graph/astar_search.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

/// Length [m] of the shortest way that goes along the axes and diagonals of the cells.
///
/// All lengths of the search are in this norm, which makes it an exact bound on an empty map.
struct CellNorm {
    double width, height, diagonal;  ///< of a cell [m]

    explicit CellNorm(const MapFrame& frame)
        : width(frame.cell_width()),
          height(frame.cell_height()),
          diagonal(std::sqrt(width * width + height * height)) {}

    double operator()(CellPoint a, CellPoint b) const {
        const double u = std::abs(b.u - a.u);
        const double v = std::abs(b.v - a.v);
        const double both = std::min(u, v);
        return both * diagonal + (u - both) * width + (v - both) * height;
    }
};

/// A way from an end of the path to the centre of a cell near it.
struct Access {
    int cell;
    double length;  ///< in CellNorm [m]
};

/// The free cells and the two ends of the path as a graph for Boost. Vertices are the cells, then
/// the start, then the goal. Nothing is stored but the steps allowed from each cell.
struct CellGraph {
    struct Edge {
        int from;
        int to;
        double length;  ///< in CellNorm [m]
        friend constexpr bool operator==(Edge, Edge) = default;
    };

    std::span<const std::uint8_t> moves;
    std::array<int, 8> offset{};
    std::array<double, 8> length{};  ///< [m]
    std::span<const Access> from_start;
    std::span<const Access> to_goal;

    int start() const { return static_cast<int>(moves.size()); }
    int goal() const { return start() + 1; }

    /// The way from a cell near the goal to the goal.
    const Access* goal_access(int cell) const {
        for (const Access& access : to_goal)
            if (access.cell == cell) return &access;
        return nullptr;
    }
    /// Bits 0 to 7: steps; bit 8: the goal. For the start: one bit for each way to a cell.
    std::uint32_t exits(int vertex) const {
        if (vertex == start()) return (1u << from_start.size()) - 1;
        if (vertex == goal()) return 0;
        const std::uint32_t last = goal_access(vertex) ? 1u << 8 : 0;
        return moves[static_cast<std::size_t>(vertex)] | last;
    }
    Edge edge(int vertex, int exit) const {
        const auto i = static_cast<std::size_t>(exit);
        if (vertex == start()) return {vertex, from_start[i].cell, from_start[i].length};
        if (exit == 8) return {vertex, goal(), goal_access(vertex)->length};
        return {vertex, vertex + offset[i], length[i]};
    }
};

/// Goes over the set bits of exits().
class ExitIterator : public boost::iterator_facade<ExitIterator, CellGraph::Edge,
                                                   boost::forward_traversal_tag, CellGraph::Edge> {
  public:
    ExitIterator() = default;
    ExitIterator(const CellGraph* graph, int vertex, std::uint32_t exits)
        : graph_(graph), vertex_(vertex), exits_(exits) {}

  private:
    friend class boost::iterator_core_access;
    CellGraph::Edge dereference() const { return graph_->edge(vertex_, std::countr_zero(exits_)); }
    void increment() { exits_ &= exits_ - 1; }
    bool equal(const ExitIterator& other) const { return exits_ == other.exits_; }

    const CellGraph* graph_ = nullptr;
    int vertex_ = 0;
    std::uint32_t exits_ = 0;
};

// What Boost.Graph calls an incidence graph; found by argument-dependent lookup.
int source(const CellGraph::Edge& edge, const CellGraph&) { return edge.from; }
int target(const CellGraph::Edge& edge, const CellGraph&) { return edge.to; }
std::pair<ExitIterator, ExitIterator> out_edges(int vertex, const CellGraph& graph) {
    return {{&graph, vertex, graph.exits(vertex)}, {&graph, vertex, 0}};
}
[[maybe_unused]] std::size_t out_degree(int vertex, const CellGraph& graph) {
    return static_cast<std::size_t>(std::popcount(graph.exits(vertex)));
}

}  // namespace
}  // namespace rovernet

template <>
struct boost::graph_traits<rovernet::CellGraph> {
    using vertex_descriptor = int;
    using edge_descriptor = rovernet::CellGraph::Edge;
    using out_edge_iterator = rovernet::ExitIterator;
    using degree_size_type = std::size_t;
    using directed_category = boost::directed_tag;
    using edge_parallel_category = boost::disallow_parallel_edge_tag;
    struct traversal_category : boost::incidence_graph_tag {};
    static int null_vertex() { return -1; }
};

namespace rovernet {
namespace {

struct GoalFound {};

struct StopAtGoal : boost::default_astar_visitor {
    int goal;
    explicit StopAtGoal(int vertex) : goal(vertex) {}
    void examine_vertex(int vertex, const CellGraph&) const {
        if (vertex == goal) throw GoalFound{};
    }
};

/// Lower bound of the way to the goal [m]: as if every cell were free.
struct DistanceToGoal {
    CellNorm norm;
    int columns;
    int cells;
    CellPoint start;
    CellPoint goal;

    double operator()(int vertex) const {
        if (vertex >= cells) return vertex == cells ? norm(start, goal) : 0;
        return norm({vertex % columns + 0.5, vertex / columns + 0.5}, goal);
    }
};

/// The cells from the start to the goal, or nothing.
std::vector<int> search(const CellGraph& graph, const DistanceToGoal& bound) {
    const auto vertices = static_cast<std::size_t>(graph.goal()) + 1;
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> so_far(vertices, infinity);
    std::vector<double> total(vertices, infinity);
    std::vector<int> before(vertices, -1);
    std::vector<boost::default_color_type> color(vertices, boost::white_color);
    const boost::typed_identity_property_map<int> index;
    so_far[static_cast<std::size_t>(graph.start())] = 0;
    total[static_cast<std::size_t>(graph.start())] = bound(graph.start());
    const auto length = boost::make_function_property_map<CellGraph::Edge>(
        [](const CellGraph::Edge& edge) { return edge.length; });
    const auto map = [&](auto& values) {
        return boost::make_iterator_property_map(values.begin(), index);
    };
    try {
        boost::astar_search_no_init(graph, graph.start(), bound, StopAtGoal(graph.goal()),
                                    map(before), map(total), map(so_far), length, map(color), index,
                                    std::less<>{}, std::plus<>{}, infinity, 0.0);
    } catch (GoalFound) {
        std::vector<int> cells;
        for (int v = before[vertices - 1]; v != graph.start();
             v = before[static_cast<std::size_t>(v)])
            cells.push_back(v);
        std::reverse(cells.begin(), cells.end());
        return cells;
    }
    return {};
}

CellPoint centre(int column, int row) { return {column + 0.5, row + 0.5}; }

/// Ways between an end of the path and the centres of free cells around it, ring by ring until
/// enough are found; nearest first.
std::vector<Access> ways_to_cells(const Scene& scene, Meters radius,
                                  const std::vector<std::uint8_t>& free, Vec3 end) {
    constexpr std::size_t enough = 8, most = 16;
    const OccupancyGrid& grid = scene.grid();
    const CellNorm norm(scene.frame());
    const CellPoint p = scene.frame().to_cells(end);
    const int column = std::min(static_cast<int>(p.u), grid.columns - 1);
    const int row = std::min(static_cast<int>(p.v), grid.rows - 1);
    const double rings = radius.value / std::min(grid.cell_width, grid.cell_height) + 2;
    const int last_ring =
        static_cast<int>(std::min(rings, std::max(grid.columns, grid.rows) + 0.0));
    std::vector<Access> ways;
    for (int k = 0; k <= last_ring && ways.size() < enough; ++k)
        for (int j = std::max(row - k, 0); j <= std::min(row + k, grid.rows - 1); ++j)
            for (int i = std::max(column - k, 0); i <= std::min(column + k, grid.columns - 1);
                 ++i) {
                const int cell = j * grid.columns + i;
                if (std::max(std::abs(i - column), std::abs(j - row)) == k &&
                    free[static_cast<std::size_t>(cell)] &&
                    scene.passable(end, scene.frame().to_world(centre(i, j)), radius))
                    ways.push_back({cell, norm(p, centre(i, j))});
            }
    std::sort(ways.begin(), ways.end(), [](const Access& a, const Access& b) {
        return std::pair(a.length, a.cell) < std::pair(b.length, b.cell);
    });
    if (ways.size() > most) ways.resize(most);
    return ways;
}

/// Some cell of the one lies in the same part of the map as some cell of the other.
bool joined(const std::vector<Access>& from, const std::vector<Access>& to,
            const std::vector<std::int32_t>& part) {
    const auto part_of = [&](const Access& access) {
        return part[static_cast<std::size_t>(access.cell)];
    };
    return std::any_of(from.begin(), from.end(), [&](const Access& a) {
        return std::any_of(to.begin(), to.end(),
                           [&](const Access& b) { return part_of(a) == part_of(b); });
    });
}

using Path = std::vector<Vec3>;

double length_of(const Path& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
    return sum;
}

/// The same way with points no farther apart than `spacing` [m].
Path subdivided(const Path& path, double spacing) {
    Path points{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Vec3 start = path[i - 1], along = path[i] - path[i - 1];
        const int parts = static_cast<int>(distance(path[i - 1], path[i]) / spacing) + 1;
        for (int k = 1; k < parts; ++k) points.push_back(start + (1.0 * k / parts) * along);
        points.push_back(path[i]);
    }
    return points;
}

/// From each corner straight to a far point in sight: the farthest that doubling jumps find.
Path straightened(const Scene& scene, Meters radius, const Path& path) {
    Path corners{path.front()};
    for (std::size_t anchor = 0; anchor + 1 < path.size();) {
        const auto sees = [&](std::size_t i) {
            return i < path.size() && scene.passable(path[anchor], path[i], radius);
        };
        std::size_t next = anchor + 1;
        std::size_t jump = 1;
        for (; sees(next + jump); jump *= 2) next += jump;
        for (; jump > 0; jump /= 2)
            if (sees(next + jump)) next += jump;
        corners.push_back(path[next]);
        anchor = next;
    }
    return corners;
}

bool passable(const Scene& scene, Meters radius, const Path& path) {
    for (std::size_t i = 1; i < path.size(); ++i)
        if (!scene.passable(path[i - 1], path[i], radius)) return false;
    return true;
}

/// Straightened from the start, then, its points a cell apart, from the goal.
Path pulled_tight(const Scene& scene, Meters radius, const Path& cells) {
    const double spacing = std::max(scene.frame().cell_width(), scene.frame().cell_height());
    const Path forward = straightened(scene, radius, cells);
    Path points = subdivided(forward, spacing);
    std::reverse(points.begin(), points.end());
    Path both = straightened(scene, radius, points);
    std::reverse(both.begin(), both.end());
    // Rounded points between passable ones may miss the radius by a hair.
    const bool better = length_of(both) < length_of(forward) && passable(scene, radius, both);
    return better ? both : forward;
}

Meters checked(Meters radius) {
    if (radius.value >= 0 && std::isfinite(radius.value)) return radius;
    throw std::invalid_argument(
        fmt::format("Planner: radius must be >= 0 m, got {} m", radius.value));
}

}  // namespace

Planner::Planner(const Scene& scene, Meters radius)
    : scene_(&scene), radius_(checked(radius)), space_(scene, radius) {}

std::optional<std::vector<Vec3>> Planner::shortest_path(Vec3 from, Vec3 to) const {
    const Scene& scene = *scene_;
    if (!scene.inside_map(from) || !scene.inside_map(to)) return std::nullopt;
    if (scene.passable(from, to, radius_)) return Path{from, to};
    const auto from_start = ways_to_cells(scene, radius_, space_.free, from);
    const auto to_goal = ways_to_cells(scene, radius_, space_.free, to);
    if (!joined(from_start, to_goal, space_.part)) return std::nullopt;

    const int columns = scene.grid().columns;
    const CellNorm norm(scene.frame());
    CellGraph graph{space_.steps, {}, {}, from_start, to_goal};
    for (std::size_t d = 0; d < cell_steps.size(); ++d) {
        graph.offset[d] = cell_steps[d].row * columns + cell_steps[d].column;
        graph.length[d] = norm({0, 0}, {cell_steps[d].column + 0.0, cell_steps[d].row + 0.0});
    }
    const DistanceToGoal bound{norm, columns, graph.start(), scene.frame().to_cells(from),
                               scene.frame().to_cells(to)};
    const std::vector<int> cells = search(graph, bound);
    if (cells.empty()) return std::nullopt;
    Path path{from};
    for (const int cell : cells)
        path.push_back(scene.frame().to_world(centre(cell % columns, cell / columns), from.z));
    path.push_back(to);
    return pulled_tight(scene, radius_, path);
}

std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius) {
    return Planner(scene, radius).shortest_path(from, to);
}

}  // namespace rovernet
