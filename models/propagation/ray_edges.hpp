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

/// Point projected into the plane z = 0.
inline Vec3 in_plan(Vec3 p) { return {p.x, p.y, 0}; }
/// Cross product in plan: positive if the second vector is to the left of the first.
inline double cross_in_plan(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }

/// Convex vertical edge of a wall, seen in plan: a free end or a corner.
///
/// The end of a thin wall has two corners near each other. Both corners form one edge, the edge of
/// a screen. Otherwise the shadow of a wall would depend on the shape of its end: a sheet, a wedge
/// or a brick. A path around an edge is a taut string that touches one or both of its corners.
struct WallEdge {
    /// Indices of the faces before and behind the edge, in the order of the outline.
    std::size_t before, behind;
    /// Corners of the edge [m]: end of the face before the edge, and start of the face behind it.
    std::array<Vec3, 2> corners;
    /// Unit vector from the edge back along the face before the edge.
    Vec3 back;
    /// Exterior angle of the edge over pi [-], > 1 and <= 2.
    double n;
    /// Height of the wall at the edge [m].
    double height;
    /// Largest distance [m] of the outline as drawn (in steps of pixels) from the straight lines of
    /// the edge's two faces; 0 if the faces are parallel to the map's grid.
    double steps;
    /// Indices of the neighbouring edges: `previous` at the other end of the face before the edge,
    /// `next` at the other end of the face behind it; no_edge if there is no such edge.
    std::size_t previous, next;
    /// True if the corners are at most a wavelength apart, as at the end of a thin wall: both
    /// corners then count as one.
    bool thin;
};
inline constexpr std::size_t no_edge = static_cast<std::size_t>(-1);

/// Corner of an edge.
struct EdgeCorner {
    Vec3 at;           ///< position of the corner [m], z = 0
    std::size_t edge;  ///< index of the corner's edge
};

/// Corners that a taut string touches. The string is stretched from `from` to `to`, around the
/// bodies to which `corners` belong; the bodies are on its left.
std::vector<EdgeCorner> touched(std::span<const EdgeCorner> corners, Vec3 from, Vec3 to);

/// Taut string around bodies, in plan, with the bodies on its left.
struct TautString {
    Vec3 from, to;  ///< ends of the string [m], z = 0
    std::vector<EdgeCorner> touched;
    /// Distances along the string [m] from its start to each of its points, see point().
    std::vector<double> at;

    /// Point i of the taut string: its start, the corners that it touches, and its end.
    Vec3 point(std::size_t i) const {
        return i == 0 ? from : i > touched.size() ? to : touched[i - 1].at;
    }
    double length() const { return at.back(); }
    /// Index of a corner among the touched corners; empty if the string does not touch it.
    std::optional<std::size_t> touches(const EdgeCorner& corner) const;
};

/// Flags of the faces of an edge. A flag is true if a straight path crosses the face before the
/// edge, the face behind the edge, or a face between the edge's corners.
struct CrossedAt {
    bool before = false, behind = false;
    bool between = false;  ///< true: the path crosses a short face between `before` and `behind`
    bool any() const { return before || behind || between; }
};

/// Path around an edge, or around several edges of one body.
struct WayAround {
    std::array<std::size_t, 2> edges;  ///< indices of the first and the last edge of the path
    std::array<Vec3, 2> corners;       ///< first and last corner of the path [m]
    RayEdge edge;                      ///< edge, or pair of edges, with 3-D lengths of the path
    double length;                     ///< length of the path around the edge [m]
    double detour;                     ///< `length` minus the straight distance of the ends [m]
};

/// Edges of a scene's walls at one wavelength. Each wall has an outline, a closed chain of faces.
///
/// A face is short if its length is below five wavelengths and below 0.4 of the longest face of its
/// outline. The corners between two consecutive long faces form one edge, with all short faces
/// between these two, if the outline turns left by more than 20 degrees from the first long face to
/// the second. Therefore the end of a wall is one edge, and a pillar has four edges.
class RayEdges {
  public:
    RayEdges() = default;
    /// @param faces  faces of the walls; must outlive the RayEdges
    RayEdges(std::span<const Face> faces, double wavelength);
    std::span<const WallEdge> all() const { return edges_; }

    /// Path from a around the edge to b, with linearly changing height. Empty if a or b lies behind
    /// the planes of both faces of the edge, or if the path passes above the wall.
    std::optional<WayAround> around(std::size_t edge, Vec3 a, Vec3 b) const;

    /// Path from a around a body to b: a taut string over the edges from `first`, where the
    /// straight path enters the body, to the edge where the straight path leaves the body. The
    /// result contains only the first and the last corner that the string touches.
    /// @param crossed  faces that the straight path crosses, by edge
    /// @param corners  the path's corners are appended, in the order of the outline
    /// @return empty if the outline does not turn left all the way, or no corner obstructs the path
    std::optional<WayAround> around_body(std::size_t first, std::span<const CrossedAt> crossed,
                                         Vec3 a, Vec3 b, std::vector<EdgeCorner>& corners) const;

    /// Extends a path around one corner of an edge by the next corner that the path passes, if the
    /// detour by that corner is less than `near_edge` wavelengths. The two corners then form one
    /// pair of edges.
    /// @param shadowed  whether the edge obstructs the straight path
    /// @return index of the added corner's edge, or no_edge
    std::size_t join_next_corner(WayAround& way, std::size_t edge, bool shadowed, Vec3 a,
                                 Vec3 b) const;

    /// Writes, for each edge, which of its faces a straight path crosses.
    /// @param faces  faces that the path crosses
    void find_crossed(std::span<const std::size_t> faces, std::vector<CrossedAt>& crossed) const;

    /// Whether a face belongs to an edge. In the order of the outline, the face is directly before
    /// the edge, directly behind it, or between the two corners of the edge.
    bool is_of(std::size_t face, std::size_t edge) const {
        return edges_[edge].before == face || edges_[edge].behind == face ||
               of_face_[face].between == edge;
    }
    /// Index of the wall's face at an edge: the longer of the faces before and behind the edge.
    std::size_t wall_at(std::size_t edge) const {
        const WallEdge& e = edges_[edge];
        return faces_[e.before].length >= faces_[e.behind].length ? e.before : e.behind;
    }
    /// Index of the edge to which both faces f and g belong, or no_edge.
    std::size_t edge_of(std::size_t f, std::size_t g) const;

    /// Index of the edge that has the face between its corners, or no_edge.
    std::size_t edge_with(std::size_t face) const { return of_face_[face].between; }

    /// Whether a face belongs to an end of a path around a body: the face is before the edge
    /// `first`, behind the edge `last`, or between the two corners of one of these edges.
    bool is_at(std::size_t face, std::size_t first, std::size_t last) const {
        const EdgesOfFace& of = of_face_[face];
        return of.before == first || of.between == first || of.behind == last || of.between == last;
    }

  private:
    /// Indices of the edges to which a face belongs: the edge that has the face before its corners,
    /// the edge that has the face behind its corners, and the edge that has it between them.
    struct EdgesOfFace {
        std::size_t before = no_edge, behind = no_edge, between = no_edge;
    };
    void add_outline(std::span<const Face> outline, std::size_t first, double shortest);
    void link_edges(std::size_t first_edge, std::span<const Face> outline, std::size_t first);
    bool corners_past(std::size_t first, std::span<const CrossedAt> crossed,
                      std::vector<EdgeCorner>& out) const;
    std::optional<WayAround> around_corners(std::span<const EdgeCorner> corners, Vec3 a, Vec3 b,
                                            bool forward) const;

    std::span<const Face> faces_;
    double wavelength_ = 0;
    std::vector<WallEdge> edges_;
    std::vector<EdgesOfFace> of_face_;
};

}  // namespace rovernet
