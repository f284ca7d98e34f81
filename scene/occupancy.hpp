// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// State of a cell of a map. An occupied cell blocks radio and robots; an unknown cell blocks only
/// robots.
enum class Cell : std::uint8_t { free, occupied, unknown };

/// Map of equal rectangular cells, placed in the world.
/// Example: examples/walls.cpp.
struct OccupancyGrid {
    int columns = 0;
    int rows = 0;
    double cell_width = 1;    ///< width of a cell, along the rows [m], > 0
    double cell_height = 1;   ///< height of a cell, along the columns [m], > 0
    Vec3 origin{};            ///< lower-left corner of cell (0, 0) [m]
    double yaw = 0;           ///< rotation about the origin, counter-clockwise [rad]
    std::vector<Cell> cells;  ///< state of each cell, columns * rows; row 0 is the bottom row
    /// Grey level of each cell: mean of red, green and blue of its pixel [0..255]; empty if the map
    /// has no image.
    std::vector<std::uint8_t> greys = {};
    std::uint8_t material = 0;  ///< material of all walls: index into Scene::materials()
    /// Material of each cell; empty: `material` for all cells.
    std::vector<std::uint8_t> cell_materials = {};
    bool open_ground = false;  ///< whether robots may leave the map: the ground around it is free

    /// Material of a cell, by the cell's index in `cells`; meaningful only for occupied cells.
    std::uint8_t material_of(std::size_t cell) const {
        return cell_materials.empty() ? material : cell_materials[cell];
    }
    /// State of the cell in a column and row, counted from 0; both must lie in the grid.
    Cell at(int column, int row) const {
        return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

/// Reads a map of the ROS map_server: a YAML file that names an image.
///
/// Keys: image (relative to the YAML file), resolution [m per pixel], origin [x, y, yaw] of the
/// lower-left corner [m, m, rad]; optional: occupied_thresh (0.65), free_thresh (0.25), negate (0),
/// mode (trinary). With shade = mean of red, green and blue [0..1] and occ = 1 - shade (negate:
/// shade), a cell is occupied if occ > occupied_thresh, free if occ < free_thresh, else unknown.
///   trinary  an alpha channel is averaged into shade with the colours
///   scale    a pixel that is not opaque is unknown
///   raw      shade * 255, rounded, is occ in percent (negate has no effect); above 100: unknown
/// Source: nav2_map_server, map_io.cpp (its intermediate percentages are unknown here). If the file
/// gives only one threshold, the default of the other threshold is adapted, so that free_thresh is
/// at most occupied_thresh.
/// @param notices  receives "file:line:column: text" for each key that a map cannot have
/// @throws InputError with file, line and column; a misspelt key is an error
OccupancyGrid read_ros_map(const std::string& yaml_path, std::vector<std::string>& notices);
/// Reads a ROS map and ignores its notices.
OccupancyGrid read_ros_map(const std::string& yaml_path);

/// Map made of an image without a YAML file. `width` and `height` of the map [m] must be > 0. The
/// lower-left corner is at (0, 0).
///
/// A pixel is a wall if the mean of red, green and blue is below one half. Otherwise the pixel is
/// free. A fully transparent pixel is free, too.
/// @throws InputError as read_image(); std::invalid_argument if a size is not positive and finite
OccupancyGrid image_map(const std::string& path, Meters width, Meters height);

}  // namespace rovernet
