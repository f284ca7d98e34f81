// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/edges/edge_pair.hpp"
#include "sim/complex_math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// Paths of radio waves between two antennas: only geometry, without the effect of materials.
// Therefore the paths of a link can be stored and evaluated again for other materials.

namespace rovernet {

/// Smallest cosine between a path and a wall's normal [-]: paths nearly parallel to a wall count as
/// paths at 89 degrees.
inline constexpr double grazing = 0.0174524064373;

/// Interaction of a path with a wall.
struct RayHit {
    enum class Kind : std::uint8_t {
        crossing,   ///< the path passes through the wall
        reflection  ///< the path is reflected by the wall
    };
    Kind kind;
    /// Index of the reflecting face, or of the face whose normal defines the angle of a crossing;
    /// no_face if the whole path lies inside the wall.
    std::size_t face;
    /// Material of the wall: index into Scene::materials().
    std::size_t material;
    /// Drawn thickness [m] of the wall, perpendicular to its face.
    double thickness;
    /// Cosine of the angle between the path and the wall's normal [-], `grazing` to 1.
    double cosine;
    /// Length of the path inside the wall [m]; 0 for a reflection.
    double length;
};
inline constexpr std::size_t no_face = static_cast<std::size_t>(-1);

/// Edge that a path goes around: the free end of a wall, or a corner.
struct RayEdge {
    /// Path lengths before and after the edge [m], in three dimensions.
    double before, after;
    /// Detour [m]: length of the path around the edge minus length of the straight path.
    double detour;
    /// Exterior angle of the edge over pi [-], 1 to 2, and the directions from the edge to the
    /// path's ends [rad], measured from the edge's first face: see WedgePath.
    double n, phi_before, phi_after;
    /// Wall at the edge: material (index into Scene::materials()), thickness [m], and cosine of the
    /// angle between the straight path and the wall's normal [-].
    std::size_t material;
    double thickness, cosine;
    /// True if the straight path crosses a face at the edge.
    bool shadowed = false;
    /// Pair of edges, if the path also goes around a second edge of this edge's body. All other
    /// members of RayEdge then describe the path around the pair.
    std::optional<EdgePair> pair = std::nullopt;
    /// Field past the edge, relative to free space; set if the field also depends on other bodies.
    std::optional<math::Complex> field = std::nullopt;
};

/// Path between two antennas.
struct RayPath {
    /// Length of the path [m], in three dimensions.
    double length;
    /// Interactions of the path with walls: range of indices into RayPaths::all_hits.
    std::size_t first_hit, hits;
    /// Edges that the path goes around: range of indices into RayPaths::all_edges.
    std::size_t first_edge = 0, edges = 0;
};

/// Paths of a link: the straight path, paths around edges, and reflected paths.
struct RayPaths {
    std::vector<RayPath> paths;
    std::vector<RayHit> all_hits;
    std::vector<RayEdge> all_edges;
    /// Edge with the smallest detour (RayEdge::detour) among the edges beside the straight path
    /// that do not obstruct this path. Empty without such an edge, and if paths are traced without
    /// edges.
    std::optional<RayEdge> beside = std::nullopt;

    std::span<const RayHit> hits(const RayPath& path) const {
        return std::span(all_hits).subspan(path.first_hit, path.hits);
    }
    std::span<const RayEdge> edges(const RayPath& path) const {
        return std::span(all_edges).subspan(path.first_edge, path.edges);
    }
    void clear() {
        paths.clear();
        all_hits.clear();
        all_edges.clear();
        beside.reset();
    }
};

}  // namespace rovernet
