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
    /// Ends of the face in plan [m], z = 0; the wall is on the left side when going from `from` to
    /// `to`.
    Vec3 from, to;
    /// Unit vector in plan, pointing out of the wall.
    Vec3 normal;
    /// Distance between the ends [m]; 0 if nothing of the side is left between its two neighbours.
    double length = 0;
    /// Largest distance between the drawn outline and the face's line [m]; 0 if the outline follows
    /// the grid.
    double deviation = 0;
    /// True if the drawn outline climbs by two cells or more along the face; otherwise a deviation
    /// is only a bump.
    bool slants = false;
    /// Thickness of the wall behind the face [m]: the median of three measurements perpendicular to
    /// the face, each to the line of the opposite face if that is nearly parallel; at most 5 m.
    double thickness = 0;
    /// Material of the wall: index into Scene::materials().
    std::size_t material = 0;
    /// Height of the wall at the face [m].
    double height = std::numeric_limits<double>::infinity();
    /// Number of the wall outline to which the face belongs. The faces of an outline are
    /// consecutive, in its order; the first follows the last.
    std::size_t outline = 0;

    /// Distance of a point in front of the face's line [m]; negative behind it.
    double in_front(Vec3 p) const { return (p.x - from.x) * normal.x + (p.y - from.y) * normal.y; }
    /// Whether both faces are sides of one straight wall: they face away from each other within 25
    /// degrees.
    bool opposite(const Face& other) const { return dot(normal, other.normal) < -0.9; }
};

/// Walls of one material on one map, the input for making faces.
struct WallsOfMap {
    MapFrame frame;
    std::shared_ptr<const WallIndex> walls;  ///< spatial index of the walls; not null
    std::size_t material;                    ///< index into Scene::materials()
    double height;                           ///< height of the walls [m]
    std::size_t map;                         ///< index of the map in the scene
};

/// Walls of a scene as straight faces, which follow the drawn walls and not the cell edges.
///
/// A slanting wall on a map is a staircase of cells, which would reflect only along rows and
/// columns. A face is the straight line fitted to a staircase, see straight_sides(). Consecutive
/// faces meet where their lines intersect, if that is within 1.5 cells of the outline's corner.
/// Touching walls of one map have one common outline, whatever their materials; a face has one
/// material. Floors and ceilings are not faces.
///
/// Faces are computed on first use; several threads may call at once.
class Faces {
  public:
    /// @param walls  walls of all maps; those of one map are consecutive
    explicit Faces(std::vector<WallsOfMap> walls) : walls_(std::move(walls)) {}

    /// All faces, ordered by map and outline.
    std::span<const Face> all() const { return made().faces; }
    /// Whether any face replaces a staircase of cells that deviates from its line.
    bool any_stair() const { return made().any_stair; }
    /// Index of the face on whose drawn outline a point lies, in plan, within a millionth of a
    /// cell.
    /// @param material  material of the face
    std::optional<std::size_t> at(Vec3 p, std::size_t material) const;

  private:
    /// Consecutive edges of an outline on one grid line.
    struct Run {
        std::size_t edge;  // index of the first edge
        int end;           // end behind the last edge, along the line [cells]
        std::size_t face;
    };
    /// Edges of one map's grid between neighbouring grid points, numbered line by line: first on
    /// the columns' lines u = 0 ... columns, then on the rows' lines v = 0 ... rows.
    struct Lines {
        MapFrame frame;
        int columns, rows;
        std::vector<Run> runs = {};  // in ascending order of edge number
        CountedBits begins = {};     // numbers of the first edges of runs

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
