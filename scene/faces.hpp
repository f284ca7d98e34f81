// SPDX-License-Identifier: MIT
#pragma once

#include "scene/counted_bits.hpp"
#include "scene/map_frame.hpp"
#include "scene/once.hpp"
#include "scene/outline.hpp"
#include "scene/wall_index.hpp"
#include "sim/geometry.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Straight vertical side of a wall that reflects radio waves, from the floor to a height.
struct Face {
    /// Ends of the face in the horizontal plane [m], z = 0. The wall is on the left when going from
    /// `from` to `to`.
    Vec3 from, to;
    /// Unit normal of the face: a horizontal vector that points out of the wall.
    Vec3 normal;
    /// Length of the face [m]; 0 if the lines of the two adjacent faces cut off the whole face.
    double length = 0;
    /// Largest distance between the wall's outline as drawn on the map and the straight line of the
    /// face [m]; 0 if the outline follows the grid.
    double deviation = 0;
    /// True if the drawn outline extends over two cells or more in both directions of the grid: the
    /// face is oblique. False: any deviation is only a bump.
    bool slants = false;
    /// Thickness of the wall behind the face [m], at most 5 m: the median of three measurements
    /// perpendicular to the face. Each measurement ends at the line of the opposite face if the two
    /// faces are nearly parallel.
    double thickness = 0;
    /// Material of the wall: index into Scene::materials().
    std::size_t material = 0;
    /// Height of the upper end of the wall at the face [m].
    double height = std::numeric_limits<double>::infinity();
    /// Number of the wall outline to which the face belongs. The faces of an outline have
    /// consecutive indices, in the order of the closed outline: the first face follows the last.
    std::size_t outline = 0;

    /// Distance of a point from the face's line [m], positive in front of the wall's face, negative
    /// behind the face.
    double in_front(Vec3 p) const { return (p.x - from.x) * normal.x + (p.y - from.y) * normal.y; }
    /// Whether this face and the other face may be the two sides of one straight wall: their
    /// normals are opposite to within 25 degrees.
    bool opposite(const Face& other) const { return dot(normal, other.normal) < -0.9; }
};

/// Walls of one material on one map, the input for making faces.
struct WallsOfMap {
    MapFrame frame;
    std::shared_ptr<const WallIndex> walls;  ///< spatial index of the walls; not null
    std::size_t material;                    ///< index into Scene::materials()
    double height;                           ///< height of the walls' upper end [m]
    std::size_t map;                         ///< index of the map in the scene
};

/// Walls of a scene as straight faces, which follow the drawn walls and not the cell edges.
///
/// A map draws an oblique wall as a staircase of cells, which would reflect only along rows and
/// columns. A face is the straight line fitted to a staircase, see straight_sides(). Consecutive
/// faces meet at the intersection of their lines, if it is within 1.5 cells of the outline's
/// corner. Touching walls of one map have one common outline, whatever their materials. A face has
/// one material. Floors and ceilings are not faces.
///
/// Faces are computed on first use. Several threads may call the functions concurrently.
class Faces {
  public:
    /// @param walls  walls of all maps; entries of the same map are consecutive
    explicit Faces(std::vector<WallsOfMap> walls) : walls_(std::move(walls)) {}

    /// All faces, ordered by map and outline.
    std::span<const Face> all() const { return made().faces; }
    /// Whether any face is a line fitted to a staircase of cells, with a deviation above 0.
    bool any_stair() const { return made().any_stair; }
    /// Index of the face whose outline, as drawn on the map, contains the point p within a
    /// millionth of a cell; the height of p is ignored. Empty if there is no such face.
    /// @param material  material of the face
    std::optional<std::size_t> at(Vec3 p, std::size_t material) const;

  private:
    /// Run of consecutive outline edges on one line of the grid, all of one face.
    struct Run {
        std::size_t edge;  // number of the first edge, see Lines::number()
        int end;           // coordinate of the end of the last edge, along the line [cells]
        std::size_t face;
    };
    /// Grid lines of one map, with the runs of outline edges on them. Edges between neighbouring
    /// grid points are numbered line by line: first on the vertical lines u = 0 ... columns, then
    /// on the horizontal lines v = 0 ... rows.
    struct Lines {
        MapFrame frame;
        int columns, rows;
        std::vector<Run> runs = {};  // in ascending order of edge number
        CountedBits begins = {};     // numbers of the edges with which runs begin

        std::size_t number(bool upright, int line, int along) const;
    };
    struct Made {
        std::vector<Face> faces;
        std::vector<Lines> maps;
        bool any_stair = false;
    };
    const Made& made() const;
    void make() const;
    void measure(Face& face) const;
    double thickness(const Face& face, double along) const;
    std::optional<std::size_t> find(Vec3 p, std::size_t material) const;
    void add_map(std::span<const WallsOfMap> walls) const;
    void add_outline(const Outline&, const std::vector<OutlineSide>&, const MapFrame&) const;
    std::optional<std::size_t> on_line(const Lines&, bool upright, int line, double along,
                                       std::size_t material) const;

    std::vector<WallsOfMap> walls_;
    mutable Once once_;
    mutable Made made_;
};

}  // namespace rovernet
