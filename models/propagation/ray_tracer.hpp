// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/edges/edge_row.hpp"
#include "models/propagation/ray_edges.hpp"
#include "models/propagation/ray_images.hpp"
#include "models/propagation/ray_materials.hpp"
#include "models/propagation/ray_path.hpp"
#include "models/propagation/rays.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Rule by which RayTracer leaves out weak paths: a limit of loss, and the data to compute losses.
struct RayLimit {
    const RayMaterials& materials;
    Hertz frequency;
    /// Largest loss of a path relative to the strongest path [dB]; weaker paths are left out.
    double faintest;
    /// Method for paths around edges, and whether reflected paths are added with their phases.
    RayDiffraction diffraction = RayDiffraction::none;
    bool coherent = false;
};

/// Finds the paths from one sender to its receivers, by the method of images.
///
/// Paths are found in plan, and their height changes linearly from one antenna to the other: walls
/// are vertical, and floors and ceilings do not reflect. A reflection above the top of the face is
/// left out. A path passes through every wall that it meets.
///
/// With edges, there are paths around one body each: around the ends of the walls that obstruct the
/// straight path, around both edges of a wide body, and around edges that do not obstruct the
/// straight path and have a detour of less than 2.25 wavelengths. Further paths go around several
/// bodies in the straight path on one side: around all of them, and around those whose transmission
/// loss exceeds the loss of the path around them.
///
/// With edges, a path that crosses the corner of a wall passes through the whole wall, to agree
/// with the path around that corner. A corner is the intersection of the lines of two faces, also
/// where the drawn outline differs from it.
///
/// Walls are as drawn, with one exception: for a path reflected by a slanting face, and for a path
/// that touches the face and leaves on the same side, the steps of the face's outline are no walls.
///
/// All numbers of a path are equal to the last bit in both directions of the link: points of a path
/// are computed from the antenna whose coordinates come first in lexicographic order.
class RayTracer {
  public:
    /// @param scene       scene with the walls; must outlive the tracer
    /// @param order       largest number of reflections
    /// @param wavelength  [m]; faces shorter than the wavelength do not reflect
    /// @param edges       whether to find paths around edges, too
    /// @param few         true: faster for few receivers, slower for many; see RayImages
    RayTracer(const Scene& scene, Vec3 from, int order, double wavelength, bool edges = false,
              bool few = false);

    /// Writes the paths to a receiver into `out`.
    /// @param limit  null: all paths; otherwise the strongest path and the paths within the limit
    void trace(Vec3 to, const RayLimit* limit, RayPaths& out);
    /// Losses [dB] of the paths that the last trace() found, in the order of the paths; only with a
    /// limit.
    std::span<const double> losses() const { return losses_; }

  private:
    /// Path that exists by geometry; its wall crossings are not computed yet.
    struct Candidate {
        double length;  // length of the path [m]
        // Index of the path's first point; the path has two more points than reflections.
        std::size_t first_point;
        std::size_t first, count;  // range of the path's reflections
        double free_space = 0;     // loss without walls [dB]
        double least_loss = 0;     // free-space loss plus a lower bound for the reflections [dB]
    };
    /// Path whose wall crossings are being computed.
    struct Draft {
        RayPaths& out;
        const RayLimit* limit;
        std::size_t first;        // index of the path's first hit
        std::size_t first_edge;   // index of the path's first edge
        double loss;              // loss so far [dB], including reflections
        bool whole_ends = false;  // a wall that is crossed at a corner counts in full thickness
        std::size_t clipped = no_edge;  // last edge whose wall was counted in full
        // Edges at the start and the end of the path's current section, which does not cross their
        // faces.
        std::array<std::size_t, 2> beside = {no_edge, no_edge};
    };
    /// Cached losses of a slab, for a material, thickness and angle. The walls of a path are mostly
    /// parallel or perpendicular, so a few entries are enough.
    struct KnownSlab {
        std::size_t material;
        double thickness, cosine;
        HitLosses losses;
    };
    /// Detour around one wall or obstacle that is in or beside the straight line from the
    /// transmitter to the receiver, and whether the detour passes on the left.
    struct BodyWay {
        std::size_t first_corner, corners;  // range in corners_, in the order of the outline
        WayAround way;
        bool left;
    };
    /// Face beside the straight path. The field of the path past the face's edges already includes
    /// the fraction `share` [-] of the face's reflection. The field of the separately traced
    /// reflection is therefore multiplied by 1 - share. The face is `face`, or if this is no_face,
    /// the face between the two corners of the edge `edge`.
    struct GrazedFace {
        std::size_t face, edge;
        double share;
    };
    void propose(Vec3 to, const RayLimit* limit);
    std::optional<Candidate> plan(std::span<const std::uint32_t> chain, const RayLimit* limit);
    bool place(std::span<const std::uint32_t> chain, double flat, std::span<Vec3> points) const;
    void add(const Candidate& path, const RayLimit* limit, RayPaths& out);
    void add_clipped(const RayLimit* limit, RayPaths& out);
    void add_diffracted(const RayLimit* limit, RayPaths& out);
    void add_around(const WayAround& way, std::span<const RayEdge> beside, const RayLimit* limit,
                    RayPaths& out);
    void bend(const RayEdge& edge, Draft& draft);
    void follow(const RayPath& straight, const WayAround& way, const RayLimit* limit,
                RayPaths& out);
    bool pass_leg(Vec3 p, std::size_t at_p, Vec3 q, std::size_t at_q, Draft& draft);
    void add_around_edge(std::size_t edge, const RayLimit* limit, RayPaths& out);
    std::span<const EdgeCorner> corners_of(const BodyWay& body) const {
        return std::span(corners_).subspan(body.first_corner, body.corners);
    }
    TautString string_around(std::span<const BodyWay* const> bodies, bool left) const;
    std::optional<RowCorner> beside(const TautString& string, const EdgeCorner& corner,
                                    std::size_t body) const;
    std::vector<EdgeCorner> corners_near(const BodyWay& body) const;
    std::vector<RowCorner> row_of(const TautString& string,
                                  std::span<const BodyWay* const> side) const;
    std::vector<RayEdge> edges_past(const TautString& string, std::span<const BodyWay* const> side,
                                    double longer) const;
    void add_around_bodies(bool left, const RayLimit* limit, RayPaths& out);
    bool takes_more_than_its_way(const BodyWay& body, const RayLimit* limit, const RayPaths& out);
    void add_row(const TautString& string, std::span<const BodyWay* const> side, bool left,
                 const RayLimit* limit, RayPaths& out);
    void pass_beside(std::size_t edge);
    void add_beside(bool left, const RayLimit* limit, RayPaths& out);
    bool is_left(Vec3 p) const;
    void sort_along(std::vector<const BodyWay*>& side, bool left) const;
    double loss_of(const RayHit& hit, const RayMaterials& materials);
    bool is_near(const WallEdge& edge, double detour) const;
    RayHit reflection(Vec3 p, Vec3 q, std::uint32_t face) const;
    bool pass(Vec3 p, Vec3 q, double begin, double end, Draft& draft);
    static double free_space(double length, Hertz f);
    bool is_faint(const Draft& draft) const;
    void finish(const Draft& draft, bool bright, double length);
    std::optional<RayHit> crossing(const Crossing& c, Vec3 from, Vec3 along, Draft& draft);
    bool is_clipped(std::size_t entry, std::size_t exit, Vec3 from, Vec3 along) const;
    std::span<const RayHit> reflections_of(const Candidate& c) const {
        return std::span(reflections_).subspan(c.first, c.count);
    }

    const Scene& scene_;
    Vec3 from_;
    std::span<const Face> faces_;
    double wavelength_;
    RayImages images_;
    RayEdges edges_;
    // Ends of the link [m], ordered by coordinates; all members below are the state of the current
    // link.
    Vec3 a_, b_;
    double best_ = 0;  // loss of the strongest path so far [dB]
    std::vector<double> losses_;
    std::vector<Candidate> candidates_;
    std::vector<RayHit> reflections_;  // reflections of all candidates
    std::vector<Vec3> points_;         // points of all candidates
    std::vector<std::uint32_t> chain_;
    std::vector<Vec3> mirrored_;
    std::vector<Crossing> crossings_;
    std::vector<std::size_t> crossed_;  // faces of the walls crossed by the last leg
    std::vector<CrossedAt> at_edge_;    // crossed faces of the straight path, by edge
    std::vector<char> done_;            // flag of each edge: a path around the edge was found
    std::vector<BodyWay> bodies_;       // paths around single bodies in the straight path
    std::vector<EdgeCorner> corners_;   // corners of the paths in bodies_
    std::vector<GrazedFace> grazed_;
    std::array<KnownSlab, 6> known_{};  // cached losses of slabs
    std::size_t next_known_ = 0;
};

}  // namespace rovernet
