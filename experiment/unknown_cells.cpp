// SPDX-License-Identifier: MIT
#include "experiment/unknown_cells.hpp"

#include "scene/map_frame.hpp"
#include "scene/occupancy.hpp"
#include "sim/told_apart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rovernet {
namespace {

/// Cell of a map that robots must not enter.
struct NearCell {
    int column = 0, row = 0;
    double distance = std::numeric_limits<double>::infinity();  ///< from the robot's centre [m]
};

/// Distance of a number from the interval [cell, cell + 1].
double beyond(double number, int cell) { return std::max({cell - number, number - cell - 1, 0.0}); }

/// Nearest cell that is not free, of those within the radius; none if all of these are free. Of
/// cells at the same distance, a wall counts as nearest.
std::optional<NearCell> nearest_obstacle(const OccupancyGrid& grid, Vec3 at, Meters radius) {
    const CellPoint c = MapFrame(grid).to_cells(at);
    const auto first = [](double low) {
        return static_cast<int>(std::floor(std::clamp(low, 0.0, 1e9)));
    };
    const double across = radius.value / grid.cell_width, along = radius.value / grid.cell_height;
    NearCell nearest;
    for (int row = first(c.v - along - 1); row < std::min<double>(grid.rows, c.v + along); ++row) {
        for (int column = first(c.u - across - 1);
             column < std::min<double>(grid.columns, c.u + across); ++column) {
            const Cell cell = grid.at(column, row);
            if (cell == Cell::free) continue;
            const double x = beyond(c.u, column) * grid.cell_width;
            const double y = beyond(c.v, row) * grid.cell_height;
            const double distance = std::sqrt(x * x + y * y);
            if (distance > nearest.distance) continue;
            if (distance == nearest.distance && cell == Cell::unknown) continue;
            nearest = {column, row, distance};
        }
    }
    if (nearest.distance >= radius.value) return std::nullopt;
    return nearest;
}

}  // namespace

std::string unknown_cell_text(const Scene& scene, Vec3 at, Meters radius, std::string_view whose) {
    if (scene.open_field()) return "";
    const OccupancyGrid& grid = scene.storey_at(at.z).grid();
    const auto nearest = nearest_obstacle(grid, at, radius);
    if (!nearest || grid.at(nearest->column, nearest->row) != Cell::unknown) return "";
    const std::string place =
        nearest->distance == 0
            ? std::string("is in an unknown cell of the map")
            : fmt::format(
                  "is nearer to an unknown cell of the map than {} of {} m (clearance {} m)", whose,
                  radius.value, told_apart(nearest->distance, radius.value, 3));
    const char* const smaller = nearest->distance == 0 ? "" : ", give it a smaller radius";
    if (grid.greys.empty())
        return fmt::format("{}; unknown cells stop robots: move the robot{}", place, smaller);
    const auto index =
        static_cast<std::size_t>(nearest->row) * static_cast<std::size_t>(grid.columns) +
        static_cast<std::size_t>(nearest->column);
    const int grey = grid.greys[index];
    constexpr double white = 255, steps = 1000;
    const double enough = (std::floor(steps * (1 - grey / white)) + 1) / steps;
    return fmt::format(
        "{}; unknown cells stop robots: move the robot{}, or give the map's YAML "
        "file a free_thresh of {:.3f}, which makes cells of grey level {} free "
        "(unless the key \"negate\" is 1)",
        place, smaller, enough, grey);
}

}  // namespace rovernet
