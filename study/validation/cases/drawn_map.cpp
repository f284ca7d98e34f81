// SPDX-License-Identifier: MIT
#include "study/validation/cases/drawn_map.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

/// Piece of the cave: what lies within a radius of a line is hollow.
struct Gallery {
    Vec3 from, to;
    double radius;  // [m]
};

constexpr std::array chambers{Gallery{{8, 9}, {11, 10}, 4.5},   Gallery{{26, 8}, {30, 7}, 4},
                              Gallery{{50, 9}, {52, 12}, 5},    Gallery{{20, 24}, {25, 25}, 5},
                              Gallery{{44, 25}, {48, 23}, 4.5}, Gallery{{9, 32}, {11, 33}, 4},
                              Gallery{{34, 34}, {38, 33}, 3.5}};
constexpr std::array galleries{Gallery{{8, 9}, {28, 8}, 1.6},    Gallery{{28, 8}, {51, 10}, 1.6},
                               Gallery{{10, 10}, {22, 24}, 1.8}, Gallery{{24, 25}, {46, 24}, 1.7},
                               Gallery{{46, 24}, {51, 11}, 1.6}, Gallery{{10, 32}, {21, 24}, 1.6},
                               Gallery{{36, 34}, {46, 24}, 1.7}, Gallery{{28, 8}, {23, 24}, 1.6}};

double distance_to(const Gallery& g, Vec3 p) {
    const Vec3 along = g.to - g.from;
    const double share = std::clamp(dot(p - g.from, along) / dot(along, along), 0.0, 1.0);
    return distance(p, g.from + share * along);
}

/// Place that stands for p in a cave without bends, so that galleries wind and walls are rough.
Vec3 unbent(Vec3 p) {
    return {p.x + 1.2 * math::sincos(0.45 * p.y).sin + 0.3 * math::sincos(2.3 * p.y + p.x).sin,
            p.y + 1.4 * math::sincos(0.38 * p.x).sin + 0.3 * math::sincos(2.1 * p.x - p.y).sin};
}

bool is_hollow(Vec3 p) {
    constexpr double rim = 1;  // [m] of rock around everything
    if (p.x < rim || p.y < rim || p.x > cave_width - rim || p.y > cave_depth - rim) return false;
    const Vec3 q = unbent(p);
    const auto near = [&](const Gallery& g) { return distance_to(g, q) < g.radius; };
    return std::any_of(chambers.begin(), chambers.end(), near) ||
           std::any_of(galleries.begin(), galleries.end(), near);
}

}  // namespace

bool DrawnBuilding::is_wall(Vec3 p) const {
    const auto holds = [&](const DrawnRectangle& r) { return r.contains(p); };
    return std::any_of(walls.begin(), walls.end(), holds) &&
           std::none_of(doors.begin(), doors.end(), holds);
}

DrawnBuilding drawn_office() {
    constexpr double width = 40, depth = 20, thin = 0.15, thick = 0.3, room = 5, door = 1;  // [m]
    constexpr int rooms = 8;
    DrawnBuilding out{.width = width, .depth = depth};
    const auto wall = [&](double x0, double y0, double x1, double y1) {
        out.walls.push_back({{x0, y0}, {x1, y1}});
    };
    for (const double y : {5.0, 7.0, 10.0, 13.0, 15.0}) wall(0, y, width, y + thin);
    for (const double y : {0.0, depth - thick}) wall(0, y, width, y + thick);
    for (const double x : {0.0, width - thick}) wall(x, 0, x + thick, depth);
    for (int i = 1; i < rooms; ++i) {
        const double x = room * i;
        wall(x, 0, x + thin, 5);
        wall(x, 7, x + thin, 13);
        wall(x, 15, x + thin, depth);
    }
    for (int i = 0; i < rooms; ++i) {
        double x = room * i + 0.5;
        for (const double y : {5.0, 7.0, 10.0, 13.0, 15.0}) {
            out.doors.push_back({{x, y}, {x + door, y + thin}});
            x += 0.7;
        }
    }
    return out;
}

bool is_rock(Vec3 p) { return !is_hollow(p); }

OccupancyGrid drawn_map(double width, double depth, double cell,
                        const std::function<bool(Vec3)>& is_wall) {
    OccupancyGrid map;
    map.columns = static_cast<int>(std::ceil(width / cell - 1e-9));
    map.rows = static_cast<int>(std::ceil(depth / cell - 1e-9));
    map.cell_width = map.cell_height = cell;
    map.cells.reserve(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const Vec3 middle{(column + 0.5) * cell, (row + 0.5) * cell};
            map.cells.push_back(is_wall(middle) ? Cell::occupied : Cell::free);
        }
    }
    return map;
}

}  // namespace rovernet
