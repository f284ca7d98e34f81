// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Outlines of walls: closed lines between the solid and free cells of a map, and straight lines
// fitted to the outlines.

namespace rovernet {

/// Straight piece of an outline along a grid line, from one grid point to another. The wall is on
/// the left of the piece's direction.
struct OutlineEdge {
    /// Ends of the piece in units of cells: (u0, v0) to (u1, v1); u counts columns, v rows.
    int u0, v0, u1, v1;
    /// Material of the wall along this edge: index into Scene::materials().
    std::uint8_t material;
};

/// Outline of a wall: a closed line of edges, each of which begins at the end of the previous edge.
/// The wall is on the left. So an outer outline is counter-clockwise, and the outline of a hole is
/// clockwise. Consecutive edges differ in direction or material.
using Outline = std::vector<OutlineEdge>;

/// Function that returns the material of the cell in a column and row, or a negative number if the
/// cell is not a wall. The function is also called for cells outside the map.
using MaterialAt = std::function<int(int column, int row)>;

/// Outlines of all walls of a map. Touching cells belong to one wall, even if their materials
/// differ, or if they touch only at a corner: a thin oblique line has one outline. Each outline
/// begins at its lowest, then leftmost point. Outlines are in the order of these points.
std::vector<Outline> outlines(int columns, int rows, const MaterialAt& material);

/// Straight line fitted to consecutive edges of the outline of a wall.
struct OutlineSide {
    /// Edges of the outline to which the line is fitted: [first, first + count), modulo the number
    /// of edges.
    std::size_t first, count;
    /// Point of the line [m], and direction of the line, a unit vector along the outline. Both are
    /// in the axes of the map: along rows and along columns.
    std::array<double, 2> point, direction;
    /// Largest distance from the line [m] of a grid point on the edges; 0 if there is one edge.
    double deviation;
};

/// Straight sides of an outline, in its order, as few as the tolerance allows. A staircase of
/// cells, by which a map draws an oblique wall, becomes one side: a line fitted by orthogonal
/// ("total") least squares. Each grid point of the staircase lies within one cell of the line. The
/// angle of the line is that of the drawn wall within about 0.3 cells over the wall's length. An
/// edge that belongs to no staircase is an exact side: a rectangle has four sides.
///
/// A staircase turns left and right alternately. Consecutive sides whose directions differ by less
/// than 45 degrees and that fit one line are joined, so that a bump of one cell does not split a
/// wall.
std::vector<OutlineSide> straight_sides(const Outline& outline, double cell_width,
                                        double cell_height);

}  // namespace rovernet
