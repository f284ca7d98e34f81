// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Outlines of walls, in cells: the closed lines that part solid cells from free ones, and the
// straight lines that they were drawn from.

namespace rovernet {

/// Straight piece of an outline along a grid line, from one grid point to another. The wall is on
/// its left.
struct OutlineEdge {
    /// Ends in cells: columns u and rows v.
    int u0, v0, u1, v1;
    /// Material of the wall beside it, the same all along.
    std::uint8_t material;
};

/// Closed line of edges, each of which begins where the one before ends. A wall is on its left:
/// around a wall it turns counter-clockwise, around a hole in one clockwise. Consecutive edges have
/// different directions or different materials.
using Outline = std::vector<OutlineEdge>;

/// Material of a cell by column and row, or a negative number where no wall is; called for cells
/// outside of the map, too.
using MaterialAt = std::function<int(int column, int row)>;

/// Outlines of all walls of a map. Cells of different materials belong to one wall. Cells that
/// touch at a corner only belong to one wall, too: so a thin slanting line has one outline. The
/// order is that of each outline's lowest, then leftmost point, where the outline begins.
std::vector<Outline> outlines(int columns, int rows, const MaterialAt& material);

/// Straight line that stands for consecutive edges of an outline.
struct OutlineSide {
    /// Edges [first, first + count) of the outline; they go on at its beginning.
    std::size_t first, count;
    /// A point of the line [m], and its direction, a unit vector along the outline. Lengths are in
    /// metres in the map's own axes.
    std::array<double, 2> point, direction;
    /// Farthest distance of a grid point of the edges from the line [m]; 0 for one edge.
    double deviation;
};

/// Straight sides of an outline, in its order: as few as the tolerance allows. A stair of cells,
/// which is how a map has a slanting wall, becomes one side. Each of its grid points lies within
/// one cell of the line, which is fitted by least squares, as in "total" or orthogonal regression:
/// its angle is that of the drawn wall within about 0.3 cells over the wall's length. An edge that
/// belongs to no stair is a side of its own, and exact: a rectangle has four sides.
///
/// A stair turns left and right in turn. Sides in a row that differ in direction by less than 45
/// degrees and fit one line become one: so a bump of one cell does not part a wall.
std::vector<OutlineSide> straight_sides(const Outline& outline, double cell_width,
                                        double cell_height);

}  // namespace rovernet
