// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/materials/material.hpp"
#include "scene/occupancy.hpp"
#include "scene/storeys.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace rovernet {

class Faces;
class Obstacles;
struct CellRectangle;
struct Contact;
struct WallLayer;

/// Rectangular part of a wall.
struct WallRectangle {
    std::array<Vec3, 4> corners;  ///< corners [m], counter-clockwise, on the floor of the map
    std::size_t material;         ///< index into Scene::materials()
    double bottom, top;  ///< heights of the wall's lower and upper end [m]; may be infinite
};

/// Wall that a segment a-b passes through.
struct Wall {
    double entry;   ///< distance from the segment's start to the entry into the wall [m]
    double exit;    ///< distance from the segment's start to the exit of the wall [m]
    double length;  ///< length of the segment inside the wall's material [m], without gaps at steps
                    ///< of a staircase and interiors of outlines
    std::size_t material;  ///< index into Scene::materials()
    Meters thickness;      ///< drawn thickness at the middle of the passage [m]
};

/// Walls of the world, for radio, motion and pictures. Immutable once built.
///
/// A default Scene is an open field without walls and bounds. The walls are the union of the
/// occupied cells of its maps (usually one), from the floor to their material's height. A map may
/// have several materials. A segment along the common edge of two occupied cells is inside the
/// wall. A segment along an outer edge is outside. Touching a corner or an edge is no crossing.
/// Adjacent walls of one material are one crossing. Where walls of two materials overlap, both are
/// counted. Unknown cells are no walls for radio, but obstacles for robots. Outside the maps there
/// are no walls. Coordinates and lengths that differ by less than 1e-9 of a cell are equal: a point
/// that near to a grid line lies on the line, a gap or a crossing that short is ignored.
///
/// Maps whose origins have different heights are storeys. A wall stands only in its storey, from
/// the storey's floor to its ceiling or to the material's height above the floor. A wall that
/// continues in the storey above is one wall.
class Scene {
  public:
    Scene();
    ~Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    /// @throws std::invalid_argument if the grid's size, cells or placement are invalid, or if it
    ///         uses a material that is not in the list
    explicit Scene(OccupancyGrid grid, std::vector<Material> materials = {Material{}});
    /// Scene of several maps, each with its own placement; maps may overlap.
    /// @param ceilings  materials of the ceilings, see Storeys
    Scene(std::vector<OccupancyGrid> maps, std::vector<Material> materials,
          std::vector<Material> ceilings = {});

    /// Whether the scene has no map; below, whether robots are confined to its map.
    bool open_field() const { return grid_.columns == 0; }
    bool has_border() const { return !open_field() && !grid_.open_ground; }

    /// Storeys of the scene: one for each different height of a map's origin, at least one.
    const Storeys& storeys() const { return storeys_; }
    /// Scene of one storey, with the storey's maps and walls; this scene if it has only one storey.
    const Scene& storey(std::size_t number) const {
        return plans_.empty() ? *this : *plans_[number];
    }
    /// Scene of the storey at the height z [m], with the storey's maps and walls.
    const Scene& storey_at(double z) const { return storey(storeys_.number_at(z)); }

    /// Crossings of the segment a-b through walls. Distances [m] are along the 3-D segment from a.
    ///
    /// Crossings from b to a are in the opposite order with exactly the same `length`. A vertical
    /// segment inside a wall is one crossing.
    /// @param out  replaced by the crossings
    void crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
    std::vector<Crossing> crossings(Vec3 a, Vec3 b) const;

    /// Walls that the segment a-b passes through, in order from a, each wall once.
    ///
    /// A slanting wall is drawn as a staircase, so a segment may leave and re-enter one wall. Two
    /// successive crossings belong to one wall if the segment leaves and re-enters by the same face
    /// (see Faces), or if the gap between them is the interior of a wall drawn as an outline (see
    /// HollowWalls). Any other gap, however narrow, separates two walls. A segment that enters and
    /// leaves a wall by the same face only touches this wall and does not pass through it.
    std::vector<Wall> walls(Vec3 a, Vec3 b) const;
    /// Whether the segment a-b passes through at least one wall, see walls().
    bool passes_wall(Vec3 a, Vec3 b) const;

    /// Total length of the segment a-b inside walls [m]; bitwise equal for the segment b-a.
    double wall_length(Vec3 a, Vec3 b) const {
        return wall_length(a, b, std::numeric_limits<double>::infinity());
    }
    /// Total length of the segment a-b inside walls [m]. Counting may stop once the total exceeds
    /// `enough` [m]: a result above `enough` is only a lower bound, any other result is exact.
    double wall_length(Vec3 a, Vec3 b, double enough) const;

    /// Total loss [dB] of the walls on the segment a-b, by the rates of their materials. Counting
    /// may stop once the total exceeds `enough` [dB]. A wall that the segment only touches has only
    /// its loss per metre. The result is bitwise equal for the segment b-a.
    /// @param rates    losses of a wall by its material, one element for each material
    /// @param scratch  vector whose memory is reused; its content is overwritten
    double wall_loss(Vec3 a, Vec3 b, std::span<const WallRate> rates, double enough,
                     std::vector<Crossing>& scratch) const;
    /// Total loss [dB] of the walls on the segment a-b, by rates for material and drawn thickness.
    double wall_loss(Vec3 a, Vec3 b, const WallRates& rates, double enough,
                     std::vector<Crossing>& scratch) const;
    /// Horizontal thickness [m] of the wall drawn on the map at point p; 0 outside walls. The
    /// height of p selects only the storey: p may be above the wall. See WallThickness.
    Meters wall_thickness(Vec3 p) const;
    /// Walls as straight faces; null on an open field. If there are several storeys, the faces are
    /// those of the lowest storey.
    const Faces* faces() const { return faces_.get(); }
    /// Materials of the walls; at least one.
    const std::vector<Material>& materials() const { return materials_; }
    /// Whether the propagation model gives the loss of all walls and all walls are infinitely high,
    /// so that the loss of a link's walls depends only on the length inside walls.
    bool plain_walls() const { return plain_; }

    /// Whether the point lies in an occupied cell; a cell includes its left and lower edges only.
    bool occupied(Vec3 p) const;
    /// Whether the point lies within the maps, edges included; always true if there is no border.
    bool inside_map(Vec3 p) const;
    /// Distance from p to the nearest obstacle [m]: 0 in or at an obstacle, infinity without
    /// obstacles.
    double clearance(Vec3 p) const;
    /// Whether a disc of the given radius [m] can move straight from a to b; touching an obstacle
    /// is allowed.
    ///
    /// The check is exact: the radius is compared with the distance of the segment to each
    /// obstacle, plus 1e-9 m. On a path between storeys each part is checked against the obstacles
    /// of its storey.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Contacts of a disc of the given radius [m] at p: with obstacles of the storey of p, and with
    /// the map's border, if there is one, which the disc's centre must not cross.
    std::vector<Contact> contacts(Vec3 p, Meters radius) const;

    /// Corners of the smallest axis-parallel box around the maps [m]; both (0, 0) on an open field.
    Vec3 lower_left() const { return lower_left_; }
    Vec3 upper_right() const { return upper_right_; }
    /// Walls as rectangles, disjoint on each map.
    std::vector<WallRectangle> wall_rectangles() const;
    /// Maps from which the walls of this scene can be built. A scene of one map returns this map. A
    /// scene of several maps returns one for each map and material, with the walls only.
    std::vector<OccupancyGrid> maps() const;
    /// Scene with the walls of `other` for radio and the obstacles of this scene for robots.
    Scene with_walls_of(const Scene& other) const;
    /// Map of the scene. For several maps: a grid around all maps, in which a cell is free if no
    /// obstacle enters the cell. For several storeys: the grid of the lowest storey.
    const OccupancyGrid& grid() const { return grid_; }
    const MapFrame& frame() const { return frame_; }
    /// Obstacles for robots, in cells of grid().
    const std::vector<CellRectangle>& obstacles() const { return obstacle_cells_; }
    /// Number of occupied cells of all maps.
    std::size_t occupied_cells() const { return occupied_cells_; }

  private:
    void build(std::vector<OccupancyGrid> maps, double bottom, double top);
    void add_storey(std::vector<OccupancyGrid> maps);
    void add_map(const OccupancyGrid& grid, double bottom, double top);
    void bound(const OccupancyGrid& grid, const MapFrame& frame);
    // Layer of all walls of the scene, if all are of one material, on one map and at all heights;
    // else null.
    const WallLayer* only_layer() const;
    void merged_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
    template <class RateOf>
    double sum_of_walls(Vec3 a, Vec3 b, double enough, std::vector<Crossing>& scratch,
                        RateOf rate_of) const;

    OccupancyGrid grid_;
    MapFrame frame_;
    std::vector<CellRectangle> obstacle_cells_;
    std::vector<Material> materials_ = {Material{}};
    Storeys storeys_;
    std::vector<std::shared_ptr<const Scene>> plans_;  // scenes of the storeys, if several
    std::vector<WallLayer> layers_;
    std::vector<Obstacles> obstacles_;
    std::shared_ptr<const Faces> faces_;
    bool plain_ = true;
    std::size_t occupied_cells_ = 0;
    Vec3 lower_left_{};
    Vec3 upper_right_{};
};

}  // namespace rovernet
