// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Outlines of walls, in cells: closed lines between solid and free cells, and straight lines fitted
// to them.

namespace rovernet {

/// Straight piece of an outline along a grid line, from one grid point to another. The wall is on
/// the left of its direction.
struct OutlineEdge {
    /// Ends of the piece in units of cells: (u0, v0) to (u1, v1); u counts columns, v rows.
    int u0, v0, u1, v1;
    /// Material of the wall along the edge.
    std::uint8_t material;
};

/// Closed line of edges; each edge begins where the previous one ends. The wall is on the left: the
/// outline of a wall is counter-clockwise, the outline of a hole clockwise. Consecutive edges
/// differ in direction or material.
using Outline = std::vector<OutlineEdge>;

/// Material of a cell by column and row, or a negative number if the cell is not a wall; also
/// called for cells outside the map.
using MaterialAt = std::function<int(int column, int row)>;

/// Outlines of all walls of a map. Touching cells of different materials belong to one wall, and so
/// do cells that touch only at a corner: a thin slanting line has one outline. Each outline begins
/// at its lowest, then leftmost point; outlines are in the order of these points.
std::vector<Outline> outlines(int columns, int rows, const MaterialAt& material);

/// Straight line fitted to consecutive edges of an outline.
struct OutlineSide {
    /// Edges [first, first + count) of the outline; after the last edge comes the first.
    std::size_t first, count;
    /// Point of the line [m] and direction of the line, a unit vector along the outline; in the
    /// map's own axes.
    std::array<double, 2> point, direction;
    /// Largest distance of a grid point of the edges from the line [m]; 0 for one edge.
    double deviation;
};

/// Straight sides of an outline, in its order, as few as the tolerance allows. A staircase of
/// cells, which is how a map draws a slanting wall, becomes one side. Each of its grid points lies
/// within one cell of the line, which is fitted by orthogonal ("total") least squares; its angle is
/// that of the drawn wall within about 0.3 cells over the wall's length. An edge that belongs to no
/// staircase is an exact side: a rectangle has four sides.
///
/// A staircase turns left and right alternately. Consecutive sides whose directions differ by less
/// than 45 degrees and that fit one line are joined, so that a bump of one cell does not split a
/// wall.
std::vector<OutlineSide> straight_sides(const Outline& outline, double cell_width,
                                        double cell_height);

}  // namespace rovernet
