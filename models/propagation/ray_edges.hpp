// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/ray_path.hpp"
#include "scene/faces.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Edge of a wall that sticks out: its free end or a corner, upright, seen in plan.
///
/// The end of a thin wall has two corners near each other. They are one edge, that of a screen:
/// else a sheet, a wedge and a brick would throw different shadows. A path goes around it as a
/// string that is drawn tight: by one of its corners, or by both.
struct WallEdge {
    /// Numbers of the faces before and behind the edge, in the order of the outline.
    std::size_t before, behind;
    /// Corners [m]: where the face before ends and where the face behind begins.
    std::array<Vec3, 2> corners;
    /// Unit vector from the edge along the face before it.
    Vec3 back;
    /// Angle of the open space over pi [-], above 1 to 2.
    double n;
    /// Height of the wall [m].
    double height;
    /// How far from the corners the drawn outline may be [m]; 0 if it runs along cells.
    double steps;
};

/// Way around an edge.
struct WayAround {
    std::array<Vec3, 2> corners;  ///< where it comes to the edge and where it leaves it [m]
    RayEdge edge;                 ///< with lengths in three dimensions
    double length;                ///< of the way [m]
    double detour;                ///< beyond the straight line between the ends [m]
};

/// Edges of a scene at one wavelength.
///
/// Faces shorter than five wavelengths between two corners do not part them: what stands between
/// the long faces before and behind is one edge, if the outline turns left there by more than 20
/// degrees in all.
class RayEdges {
  public:
    RayEdges() = default;
    /// @param faces  outlive the edges
    RayEdges(std::span<const Face> faces, double wavelength);
    std::span<const WallEdge> all() const { return edges_; }

    /// The way from a around the edge to b, which rises evenly; nothing if an end lies in the
    /// wall's side of the edge, or the way passes the edge above the wall.
    std::optional<WayAround> around(const WallEdge& edge, Vec3 a, Vec3 b) const;

  private:
    void add_outline(std::span<const Face> outline, std::size_t first, double shortest);

    std::span<const Face> faces_;
    std::vector<WallEdge> edges_;
};

}  // namespace rovernet
