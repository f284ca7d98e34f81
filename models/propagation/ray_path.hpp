// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/edges/edge_pair.hpp"
#include "sim/fields.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// Paths of radio from one antenna to another: geometry alone, without what materials do to it. So
// the paths of a link can be kept, and weighed anew for other materials.

namespace rovernet {

/// Least cosine between a path and a wall's normal [-]: ways along a wall count as ways at 89
/// degrees.
inline constexpr double grazing = 0.0174524064373;

/// A wall on a path.
struct RayHit {
    enum class Kind : std::uint8_t {
        crossing,   ///< the path passes through it
        reflection  ///< the path is reflected
    };
    Kind kind;
    /// Face of the scene that reflects, or whose normal counts; no_face if the path lies in the
    /// wall from end to end.
    std::size_t face;
    /// Material of the wall, an index into the scene's.
    std::size_t material;
    /// Thickness of the wall as drawn, square to it [m].
    double thickness;
    /// Cosine of the angle between the path and the wall's normal [-], `grazing` to 1.
    double cosine;
    /// Length of the path inside the wall [m]; 0 of a reflection.
    double length;
};
inline constexpr std::size_t no_face = static_cast<std::size_t>(-1);

/// Ways of radio around edges.
enum class RayDiffraction {
    none,
    knife_edge,  ///< edges as those of screens that let nothing through
    utd          ///< edges as wedges, by the uniform theory of diffraction
};
/// Detour around an edge [wavelengths] below which the edge acts on the straight path: up to there
/// the straight path and the way around the edge are one field.
inline constexpr double near_edge = 2.25;
/// Words of `diffraction` in files.
template <>
struct EnumNames<RayDiffraction> {
    static constexpr std::array<std::string_view, 3> values = {"none", "knife_edge", "utd"};
};

/// Edge that a path goes around: the free end of a wall, or a corner.
struct RayEdge {
    /// Ways to the edge and on from it [m], in three dimensions.
    double before, after;
    /// Length of the way around it beyond that of the straight path [m].
    double detour;
    /// Angle of the open space around the edge over pi [-], 1 to 2, and the directions from the
    /// edge to the path's ends [rad], from its first face: see WedgePath.
    double n, phi_before, phi_after;
    /// The wall at the edge: its material, an index into the scene's, its thickness [m], and the
    /// cosine of the angle between the straight path and its normal [-].
    std::size_t material;
    double thickness, cosine;
    /// The straight path passes through a face beside the edge.
    bool shadowed = false;
    /// The way also passes another edge of the same body, on one side of it or on the other: both
    /// are one, and the numbers above are of the way around both.
    std::optional<EdgePair> pair = std::nullopt;
};

/// Path between two antennas.
struct RayPath {
    /// Length [m], in three dimensions.
    double length;
    /// Hits of the path, as RayPaths has them.
    std::size_t first_hit, hits;
    /// Bodies around whose edges it goes, as RayPaths has them.
    std::size_t first_edge = 0, edges = 0;
};

/// Paths of a link: the straight one, those around edges, those with reflections.
struct RayPaths {
    std::vector<RayPath> paths;
    std::vector<RayHit> all_hits;
    std::vector<RayEdge> all_edges;
    /// Edge that the straight path passes on the lit side, with the least detour of all; none if
    /// they are not traced with edges.
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
