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
    /// Numbers of the edges that share the face before and the face behind; no_edge if none does.
    std::size_t previous, next;
    /// Both corners are within a wavelength: they are one.
    bool thin;
};
inline constexpr std::size_t no_edge = static_cast<std::size_t>(-1);

/// Faces at an edge that a straight path passes through.
struct CrossedAt {
    bool before = false, behind = false;
    bool between = false;  ///< a short face between both
    bool any() const { return before || behind || between; }
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
/// Faces that are shorter than five wavelengths, and than 0.4 of the outline's longest face, do not
/// part corners: what stands between the longer faces before and behind is one edge, if the outline
/// turns left there by more than 20 degrees in all. So the end of a wall is one edge, and a pillar
/// has its four.
class RayEdges {
  public:
    RayEdges() = default;
    /// @param faces  outlive the edges
    RayEdges(std::span<const Face> faces, double wavelength);
    std::span<const WallEdge> all() const { return edges_; }

    /// The way from a around the edge to b, which rises evenly; nothing if an end lies in the
    /// wall's side of the edge, or the way passes the edge above the wall.
    std::optional<WayAround> around(const WallEdge& edge, Vec3 a, Vec3 b) const;

    /// The way from a around a body to b: a string drawn tight over the edges from `first`, where
    /// the straight path passes through the body, to where it passes through it again. Of more than
    /// two corners the first and the last count.
    /// @param crossed  by edge
    /// @param passed   the edges of the way are appended
    /// @return nothing if the outline does not turn left all the way, or no corner is in the way
    std::optional<WayAround> around_body(std::size_t first, std::span<const CrossedAt> crossed,
                                         Vec3 a, Vec3 b, std::vector<std::size_t>& passed) const;

    /// Joins to a way around one corner of an edge the corner next to it that the way passes, if it
    /// passes it with a detour of less than `near_edge`: both are then one pair.
    /// @param shadowed  the edge stands in the straight path
    /// @return number of the other corner's edge, or no_edge
    std::size_t join_next_corner(WayAround& way, std::size_t edge, bool shadowed, Vec3 a,
                                 Vec3 b) const;

    /// Tells, for each edge, through which of its faces a straight path passes.
    /// @param faces  that it passes through
    void find_crossed(std::span<const std::size_t> faces, std::vector<CrossedAt>& crossed) const;

    /// Whether a face is part of a wall's end, and another is the wall's side next to it.
    bool is_end(std::size_t short_side, std::size_t long_side) const;

    /// Edge whose corners a face is between, or no_edge.
    std::size_t edge_with(std::size_t face) const { return of_face_[face].between; }

    /// Whether a way from edge `first` to edge `last` begins or ends at a face.
    bool is_at(std::size_t face, std::size_t first, std::size_t last) const {
        const EdgesOfFace& of = of_face_[face];
        return of.before == first || of.between == first || of.behind == last || of.between == last;
    }

  private:
    struct Corner {
        Vec3 at;
        std::size_t edge;
    };
    /// Edges that have a face before, behind and between them.
    struct EdgesOfFace {
        std::size_t before = no_edge, behind = no_edge, between = no_edge;
    };
    void add_outline(std::span<const Face> outline, std::size_t first, double shortest);
    void link_edges(std::size_t first_edge, std::span<const Face> outline, std::size_t first);
    std::vector<Corner> corners_past(std::size_t first, std::span<const CrossedAt> crossed,
                                     std::vector<std::size_t>& passed) const;
    static std::vector<Corner> touched(std::span<const Corner> corners, Vec3 from, Vec3 to);
    std::optional<WayAround> around_corners(std::span<const Corner> corners, Vec3 a, Vec3 b,
                                            bool forward) const;

    std::span<const Face> faces_;
    double wavelength_ = 0;
    std::vector<WallEdge> edges_;
    std::vector<EdgesOfFace> of_face_;
};

}  // namespace rovernet
