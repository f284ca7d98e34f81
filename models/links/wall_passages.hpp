// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstddef>
#include <vector>

// Where to look for changes of links behind walls. Between two passages the loss is smooth, so that
// a few looks decide whether the link changes in between.

namespace rovernet {

/// Point that moves straight: at(t) = from + t velocity.
struct StraightMotion {
    /// Position at t = 0 [m].
    Vec3 from = {};
    /// Velocity [m/s].
    Vec3 velocity = {};
    /// Position at t [s].
    Vec3 at(double t) const { return from + t * velocity; }
};

/// Times at which a moving line of sight may begin or cease to cross a wall, or cross it by other
/// faces. In between, the length inside each wall is a smooth function of time.
///
/// At such a time the line of sight passes a corner of a wall, or a point where the edges of two
/// overlapping walls meet; or one of its ends passes a wall's edge; or, for walls of finite height,
/// it passes an edge of the top or an end passes the height of the top; likewise for the bottom of
/// a wall on an upper floor, and for ceilings. The first and the third are roots of quadratics.
///
/// It is built once for a scene; n rectangles take O(n log n) and memory of about 150 bytes each.
class WallPassages {
  public:
    /// Passages of no walls.
    WallPassages() = default;
    /// @param scene  outlives this
    explicit WallPassages(const Scene& scene);

    /// Whether there are no walls and no ceilings.
    bool empty() const { return corners_.empty() && levels_.empty(); }

    /// Appends the times [s] in (0, duration) for the line of sight from `a` to `b`: in no order,
    /// some more than once, and some at which nothing changes. It takes a look at the corners in
    /// the tiles that the line of sight sweeps (about four each), and, where it may pass above
    /// walls, at all walls of finite height.
    void times(const StraightMotion& a, const StraightMotion& b, double duration,
               std::vector<double>& out) const;

  private:
    // Level end of a wall, its top or its bottom.
    struct End {
        /// Corners at their height [m].
        std::array<Vec3, 4> corners;
    };
    // Line of sight as it moves, for one call of times().
    struct Sight;

    // Collects the corners of a layer of walls, and the points where their edges meet.
    void collect(const std::vector<WallRectangle>& rectangles);
    // Sorts the corners into tiles.
    void sort_into_tiles();
    // Appends the times at which the line of sight passes corners.
    void pass_corners(const Sight& sight, std::vector<double>& out) const;
    // Appends the times at which an end passes an edge of a wall that stands at height z [m].
    void pass_edges(const StraightMotion& end, double z, double duration,
                    std::vector<double>& out) const;
    // Appends the times at which the line of sight, or an end, passes tops, bottoms or ceilings.
    void pass_levels(const Sight& sight, std::vector<double>& out) const;

    const Scene* scene_ = nullptr;
    // Corners, z = 0, by tile, row by row.
    std::vector<Vec3> corners_;
    // Place of the first corner of each tile; one more than tiles.
    std::vector<std::size_t> first_;
    std::vector<End> ends_;
    // Heights of tops, bottoms and ceilings [m], ascending, each once.
    std::vector<double> levels_;
    // Heights of which each is below all tops of a storey [m], one for each storey.
    std::vector<double> feet_;
    // Lower left corner of the tiles [m].
    Vec3 low_ = {};
    // Side of a tile [m], and number of tiles along each axis.
    double tile_ = 1;
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace rovernet
