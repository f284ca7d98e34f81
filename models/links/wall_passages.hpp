// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace rovernet {

/// A point that moves straight: at(t) = from + t velocity.
struct StraightMotion {
    Vec3 from = {};      ///< [m] at t = 0
    Vec3 velocity = {};  ///< [m/s]
    Vec3 at(double t) const { return from + t * velocity; }
};

/// When a moving line of sight may begin or cease to cross a wall, or cross it by other faces. In
/// between, the length inside each wall is a smooth function of time.
///
/// Those are the times at which it passes a corner of a wall, or a point where the edges of two
/// overlapping walls meet; at which one of its ends passes a wall's edge; and, for walls of finite
/// height, at which it passes a top edge or an end passes the height of the top. The first and the
/// third are roots of quadratics. Built once for a scene; n rectangles take O(n log n) and memory
/// of about 150 bytes each.
class WallPassages {
  public:
    /// No walls.
    WallPassages() = default;
    /// @param scene  outlives this
    explicit WallPassages(const Scene& scene);

    bool empty() const { return corners_.empty(); }

    /// Appends the times [s] in (0, duration) for the line of sight from `a` to `b`. In no order,
    /// some more than once, and some at which nothing changes. Time: the corners in the tiles that
    /// the line of sight sweeps (about four each), and, where it may pass above walls, all walls of
    /// finite height.
    void times(const StraightMotion& a, const StraightMotion& b, double duration,
               std::vector<double>& out) const;

  private:
    struct Top {
        std::array<Vec3, 4> corners;  // z: of the top [m]
    };
    struct Sight;

    void collect(const std::vector<WallRectangle>& rectangles);
    void sort_into_tiles();
    void pass_corners(const Sight& sight, std::vector<double>& out) const;
    void pass_edges(const StraightMotion& end, double duration, std::vector<double>& out) const;
    void pass_tops(const Sight& sight, std::vector<double>& out) const;

    const Scene* scene_ = nullptr;
    std::vector<Vec3> corners_;       // z = 0; by tile, row by row
    std::vector<std::size_t> first_;  // of each tile's corners; one more than tiles
    std::vector<Top> tops_;
    std::vector<double> heights_;  // of the tops, ascending, each once
    Vec3 low_ = {};                // [m] lower left corner of the tiles
    double tile_ = 1;              // [m] side of a tile
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace rovernet
