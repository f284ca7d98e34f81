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

/// Straight side of a wall: a mirror for radio, upright, from the floor to a height.
struct Face {
    /// Ends in plan [m], z = 0; the wall is on the left of the way from `from` to `to`.
    Vec3 from, to;
    /// Unit vector in plan that points out of the wall.
    Vec3 normal;
    /// Distance between the ends [m]; 0 for what is left of a side between two that cut it off.
    double length = 0;
    /// Farthest distance from the drawn outline to the face's line [m]; 0 if it runs along cells.
    double deviation = 0;
    /// The drawn outline climbs by two cells and more along it; if not, what deviates is a bump.
    bool slants = false;
    /// Thickness of the wall behind the face [m]: the median of three ways through its material,
    /// square to the face, each to the line of the face on the other side if that is nearly
    /// parallel; at most 5 m.
    double thickness = 0;
    /// Material of the wall, an index into the scene's.
    std::size_t material = 0;
    /// Height of the wall [m].
    double height = std::numeric_limits<double>::infinity();
    /// Number of the outline. Its faces stand together, in its order; after the last comes the
    /// first.
    std::size_t outline = 0;

    /// Distance of a point in front of the face's line [m]; negative behind it.
    double in_front(Vec3 p) const { return (p.x - from.x) * normal.x + (p.y - from.y) * normal.y; }
    /// Both are sides of one straight wall: they face away from each other within 25 degrees.
    bool opposite(const Face& other) const { return dot(normal, other.normal) < -0.9; }
};

/// Walls of one material on one map, of which faces are made.
struct WallsOfMap {
    MapFrame frame;
    std::shared_ptr<const WallIndex> walls;  ///< not null
    std::size_t material;                    ///< index into the scene's materials
    double height;                           ///< [m]
    std::size_t map;                         ///< number of the map
};

/// The walls of a scene as straight faces, each as it was drawn and not as its cells are.
///
/// A map has a slanting wall as a stair of cells, which would reflect along its rows and columns
/// only. A face is the straight line through a stair: see straight_sides(). Faces that follow one
/// another meet where their lines do, if that is within 1.5 cells of the outline's corner. Walls of
/// one map that touch have a common outline, whatever their materials; a face has one material.
/// Floors and ceilings are no faces.
///
/// They are made at the first question; questions may come from several threads.
class Faces {
  public:
    /// @param walls  those of one map stand together
    explicit Faces(std::vector<WallsOfMap> walls) : walls_(std::move(walls)) {}

    /// All faces: map by map, outline by outline.
    std::span<const Face> all() const { return made().faces; }
    /// One at least stands for a stair of cells, which its line does not follow.
    bool any_stair() const { return made().any_stair; }
    /// The face on whose drawn outline a point lies, in plan, within a millionth of a cell.
    /// @param material  the face's
    std::optional<std::size_t> at(Vec3 p, std::size_t material) const;

  private:
    /// Edges of an outline in a row on one grid line.
    struct Run {
        std::size_t edge;  // the first one's number
        int end;           // behind the last one along the line [cells]
        std::size_t face;
    };
    /// Edges of one map's grid between two points side by side. They are numbered, line by line: on
    /// u = 0 ... columns, then on v = 0 ... rows.
    struct Lines {
        MapFrame frame;
        int columns, rows;
        std::vector<Run> runs = {};  // in the order of their numbers
        CountedBits begins = {};     // numbers of edges with which runs begin

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
