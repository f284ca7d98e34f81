// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstddef>
#include <vector>

// Times at which links behind walls may change. Between two such times the loss is smooth, so a few
// samples show whether the link changes between them.

namespace rovernet {

/// Straight motion of a point at constant velocity: at(t) = from + t velocity.
struct StraightMotion {
    /// Position [m] of the moving point at the time t = 0 s.
    Vec3 from = {};
    /// Velocity [m/s] of the moving point, constant.
    Vec3 velocity = {};
    /// Position [m] of the moving point at the time t [s].
    Vec3 at(double t) const { return from + t * velocity; }
};

/// Times at which a moving line of sight may start or stop crossing a wall, or cross other faces of
/// a wall. Between these times, the length inside each wall is a smooth function of time.
///
/// At such a time the line of sight passes a corner of a wall, or a point where the edges of two
/// overlapping walls meet. Or an end of the line of sight passes a wall's edge. For walls of finite
/// height, the line of sight passes an edge of the top, or one of its ends passes the height of the
/// top. Bottoms of walls on upper floors and ceilings are handled like tops. The times for corners
/// and edges of tops are roots of quadratics.
///
/// A WallPassages is built once for a scene; n wall rectangles take O(n log n) time and about 150
/// bytes each.
class WallPassages {
  public:
    /// Empty set, for a scene without walls.
    WallPassages() = default;
    /// @param scene  scene with the walls; must outlive the WallPassages
    explicit WallPassages(const Scene& scene);

    /// Whether the scene has neither walls nor ceilings.
    bool empty() const { return corners_.empty() && levels_.empty(); }

    /// Appends the times [s] in (0, duration) at which the line of sight from `a` to `b` may start
    /// or stop crossing a wall: unsorted, some repeated, and some without a change. Checked are the
    /// corners in the tiles that the line of sight sweeps (about four each), and all walls of
    /// finite height if the line of sight may pass above walls.
    void times(const StraightMotion& a, const StraightMotion& b, double duration,
               std::vector<double>& out) const;

  private:
    // Horizontal end face of a wall: its top or its bottom.
    struct End {
        /// Corners of the wall's top or bottom, at its height [m].
        std::array<Vec3, 4> corners;
    };
    // Moving line of sight between two antennas, for one call of times().
    struct Sight;

    // Collects the corners of the walls, and the points where edges of overlapping walls meet.
    void collect(const std::vector<WallRectangle>& rectangles);
    // Sorts the corners by tile.
    void sort_into_tiles();
    // Appends the times at which the line of sight passes corners.
    void pass_corners(const Sight& sight, std::vector<double>& out) const;
    // Appends the times at which an end of the line of sight, at height z [m], passes an edge of a
    // wall.
    void pass_edges(const StraightMotion& end, double z, double duration,
                    std::vector<double>& out) const;
    // Appends the times at which the line of sight passes an edge of a wall's top or bottom, and
    // the times at which an antenna passes the height of a wall's top or bottom or of a ceiling.
    void pass_levels(const Sight& sight, std::vector<double>& out) const;

    const Scene* scene_ = nullptr;
    // Corners [m] of all walls, with z = 0, sorted by tile, row by row.
    std::vector<Vec3> corners_;
    // Index in corners_ of the first corner of each tile; the last entry is the number of corners.
    std::vector<std::size_t> first_;
    std::vector<End> ends_;
    // Heights of tops, bottoms and ceilings [m], ascending, each once.
    std::vector<double> levels_;
    // One height [m] for each storey, below the tops of all walls of the storey. At this height
    // pass_edges() finds the edges of these walls.
    std::vector<double> feet_;
    // Lower left corner [m] of the grid of tiles.
    Vec3 low_ = {};
    // Side length of a tile [m], and number of columns and rows of the grid of tiles.
    double tile_ = 1;
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace rovernet
