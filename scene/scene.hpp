// SPDX-License-Identifier: MIT
#pragma once

#include "scene/faces.hpp"
#include "scene/map_frame.hpp"
#include "scene/materials/material.hpp"
#include "scene/obstacles.hpp"
#include "scene/occupancy.hpp"
#include "scene/rectangles.hpp"
#include "scene/storeys.hpp"
#include "scene/wall_index.hpp"
#include "scene/wall_layer.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace rovernet {

/// A rectangular piece of wall.
struct WallRectangle {
    std::array<Vec3, 4> corners;  ///< [m], counter-clockwise, on the floor of its map
    std::size_t material;         ///< index into the scene's materials
    double bottom, top;           ///< heights [m] between which it stands; infinite: endless
};

/// A wall that a segment a-b passes.
struct Wall {
    double entry;   ///< from a [m]
    double exit;    ///< from a [m]
    double length;  ///< inside its material [m]; gaps at steps and insides of outlines do not count
    std::size_t material;  ///< index into the scene's materials
    Meters thickness;      ///< as drawn, under the middle of the segment's way through it [m]
};

/// The world's walls: what radio, motion and pictures read. Never changes once built.
///
/// A default Scene is an open field: no walls, no end. Walls are the union of the occupied cells of
/// its maps (usually one), of one material or several, from the floor to their material's height. A
/// segment along the common edge of two occupied cells is inside the wall, along an outer edge it
/// is outside; touching a corner or an edge counts nothing; wall against wall of one material is
/// one crossing. Where walls of two materials overlap, both count. Unknown cells are no walls for
/// radio, but obstacles for robots; beyond the maps there is nothing. Coordinates and lengths
/// within 1e-9 of a cell are equal: a point that near to a grid line lies on it, a gap that short
/// is closed, a crossing that short is none.
///
/// Maps whose origins have different heights are those of storeys, one above the other.
/// The walls of a storey stand in it alone, from its floor to its ceiling or to their material's
/// height above its floor. A wall that goes on in the storey above is one wall.
class Scene {
  public:
    Scene() = default;
    /// @throws std::invalid_argument if the grid's sizes, cells or placement make no sense, or a
    ///         material that it names is not there
    explicit Scene(OccupancyGrid grid, std::vector<Material> materials = {Material{}});
    /// Several maps, each in its place; they may overlap.
    /// @param ceilings  see Storeys
    Scene(std::vector<OccupancyGrid> maps, std::vector<Material> materials,
          std::vector<Material> ceilings = {});

    /// There is no map.
    bool open_field() const { return grid_.columns == 0; }

    /// One for each height at which there are maps, or one.
    const Storeys& storeys() const { return storeys_; }
    /// Storey as a scene of its own: its maps and walls; this scene if it has one only.
    const Scene& storey(std::size_t number) const {
        return plans_.empty() ? *this : *plans_[number];
    }
    /// Storey at a height z [m].
    const Scene& storey_at(double z) const { return storey(storeys_.number_at(z)); }

    /// Walls between two points; lengths [m] are along the 3-D segment from a.
    ///
    /// From b to a the crossings come in the opposite order with the same `length`, to the last
    /// bit. A segment straight up inside a wall is one crossing.
    /// @param out  emptied first
    void crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
    std::vector<Crossing> crossings(Vec3 a, Vec3 b) const;

    /// Walls that a segment passes, in order from a; each is there once.
    ///
    /// A wall that stands askew to the cells is drawn in steps, and a segment may leave it at each:
    /// crossings between which the segment leaves and comes back by one face (see Faces) are of one
    /// wall, and a segment that comes and leaves by the same face only touches it and passes
    /// nothing. Crossings on both sides of the inside of a wall that is drawn as an outline (see
    /// HollowWalls) are of one wall, too. Any other gap, however narrow, parts two walls.
    std::vector<Wall> walls(Vec3 a, Vec3 b) const;
    /// Whether a segment passes any of walls().
    bool passes_wall(Vec3 a, Vec3 b) const;

    /// Total length inside walls [m]; the same bits from a to b as from b to a.
    double wall_length(Vec3 a, Vec3 b) const {
        return wall_length(a, b, std::numeric_limits<double>::infinity());
    }
    /// As above, but may stop counting once the total exceeds `enough` [m]: a result above `enough`
    /// says only that, any other is exact.
    double wall_length(Vec3 a, Vec3 b, double enough) const;

    /// Loss through the walls of walls() [dB], by the rate of each wall's material; may stop
    /// counting once the total exceeds `enough` [dB]. A wall that is only touched takes its loss
    /// per metre. The same bits from a to b as from b to a.
    /// @param rates    one per material
    /// @param scratch  any vector, for its memory
    double wall_loss(Vec3 a, Vec3 b, std::span<const WallRate> rates, double enough,
                     std::vector<Crossing>& scratch) const;
    /// Loss as above, by the rate of each wall's material and drawn thickness.
    double wall_loss(Vec3 a, Vec3 b, const WallRates& rates, double enough,
                     std::vector<Crossing>& scratch) const;
    /// Drawn thickness of the walls of its storey at a point, whatever their height [m]; 0 outside
    /// of walls. See WallThickness.
    Meters wall_thickness(Vec3 p) const;
    /// The walls as straight faces; null on an open field; of several storeys, those of the lowest.
    const Faces* faces() const { return faces_.get(); }
    /// What its walls are made of; at least one.
    const std::vector<Material>& materials() const { return materials_; }
    /// All walls follow the propagation model and are infinitely high: their length tells all.
    bool plain_walls() const { return plain_; }

    /// The point lies in an occupied cell; left and lower edges belong to a cell, others do not.
    bool occupied(Vec3 p) const;
    /// The point lies within the maps, edges included; everywhere on an open field.
    bool inside_map(Vec3 p) const;
    /// Distance to the nearest obstacle [m]: 0 inside or touching, infinity if there is none.
    double clearance(Vec3 p) const;
    /// A disc of that radius [m] can move straight from a to b; touching an obstacle is allowed.
    ///
    /// Exact: the distance from the segment to each obstacle, less 1e-9 m, against the radius. From
    /// one storey to another, each part of the way is held against the obstacles of its storey.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// What a disc of that radius [m] at p touches: obstacles of its storey, and the map's border,
    /// which its middle must not cross.
    std::vector<Contact> contacts(Vec3 p, Meters radius) const;

    /// Corners of the smallest upright box around the maps [m]; both (0, 0) on an open field.
    Vec3 lower_left() const { return lower_left_; }
    Vec3 upper_right() const { return upper_right_; }
    /// The walls as rectangles, disjoint on each map.
    std::vector<WallRectangle> wall_rectangles() const;
    /// Maps that make these walls again: the map; of several, one for each map and material, with
    /// its walls only.
    std::vector<OccupancyGrid> maps() const;
    /// This scene with the walls of another for radio; robots keep to the obstacles of this one.
    Scene with_walls_of(const Scene& other) const;
    /// The map; of several, a grid around them all where a cell is free if no obstacle enters it;
    /// of several storeys, that of the lowest.
    const OccupancyGrid& grid() const { return grid_; }
    const MapFrame& frame() const { return frame_; }
    /// Where robots must not go, in cells of grid().
    const std::vector<CellRectangle>& obstacles() const { return obstacle_cells_; }
    std::size_t occupied_cells() const { return occupied_cells_; }  ///< of all maps

  private:
    void build(std::vector<OccupancyGrid> maps, double bottom, double top);
    void add_storey(std::vector<OccupancyGrid> maps);
    void add_map(const OccupancyGrid& grid, double bottom, double top);
    void bound(const OccupancyGrid& grid, const MapFrame& frame);
    // The walls, if they are of one material, on one map and endless; null if not.
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
    std::vector<std::shared_ptr<const Scene>> plans_;  // of the storeys, if there are several
    std::vector<WallLayer> layers_;
    std::vector<Obstacles> obstacles_;
    std::shared_ptr<const Faces> faces_;
    bool plain_ = true;
    std::size_t occupied_cells_ = 0;
    Vec3 lower_left_{};
    Vec3 upper_right_{};
};

}  // namespace rovernet
