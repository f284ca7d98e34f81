// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/ray_edges.hpp"
#include "models/propagation/ray_images.hpp"
#include "models/propagation/ray_materials.hpp"
#include "models/propagation/ray_path.hpp"
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

/// Limit to the paths that are worth their time.
struct RayLimit {
    const RayMaterials& materials;
    Hertz frequency;
    /// Paths are left out that lose this much more than the strongest one [dB].
    double faintest;
    /// How paths go around edges, and whether reflected paths are added with their phases.
    RayDiffraction diffraction = RayDiffraction::none;
    bool coherent = false;
};

/// Finds the paths from one sender to its receivers, by images.
///
/// The paths are planned in plan, and rise evenly from one antenna to the other: walls are upright,
/// and floors and ceilings do not reflect. A reflection at a height where the face has ended does
/// not happen. A path passes through every wall that stands in its way.
///
/// With edges, paths go around one body each: around the ends of the walls that stand in the
/// straight path, around both edges of a body that is wide, and around edges that it passes on the
/// other side with a detour of less than 2.25 wavelengths. One more path goes around each body in
/// the straight path that takes more than that.
///
/// With edges, the straight path that clips the end of a wall passes through the whole wall, as the
/// path around that end has it.
///
/// Walls are what is drawn, except where a path comes from a slanting face: the steps of the
/// outline that the face stands for are no walls, neither to the path that the face reflects nor to
/// one that touches them and leaves by the same face.
///
/// All numbers of a path are the same to the last bit in both directions: images only propose it;
/// its points are computed from that end which comes first by its coordinates.
class RayTracer {
  public:
    /// @param scene  outlives the tracer
    /// @param order  most reflections
    /// @param wavelength  [m]; shorter faces do not reflect
    /// @param edges  paths go around edges, too
    /// @param few  few receivers will be asked for: it takes less time
    RayTracer(const Scene& scene, Vec3 from, int order, double wavelength, bool edges = false,
              bool few = false);

    /// Fills `out` with the paths to a receiver.
    /// @param limit  null: all paths; else the strongest and those that are within the limit
    void trace(Vec3 to, const RayLimit* limit, RayPaths& out);
    /// Losses of the last link's paths [dB], in their order; only with a limit.
    std::span<const double> losses() const { return losses_; }

  private:
    /// Path whose walls are not looked for yet.
    struct Candidate {
        double length;             // [m]
        std::size_t first_point;   // its points, from end to end: two more than reflections
        std::size_t first, count;  // its reflections
        double free_space = 0;     // loss without walls [dB]
        double least_loss = 0;     // that and the least that reflections take [dB]
    };
    /// Path whose walls are being looked for.
    struct Draft {
        RayPaths& out;
        const RayLimit* limit;
        std::size_t first;        // of its hits
        std::size_t first_edge;   // of its edges
        double loss;              // so far [dB], reflections included
        bool whole_ends = false;  // of walls, as the ways around them have it
    };
    /// Slab that a wave met at an angle. A path meets walls side by side and square to one another:
    /// with few of these.
    struct KnownSlab {
        std::size_t material;
        double thickness, cosine;
        HitLosses losses;
    };
    /// Way around one body in the straight path, and on which side of that it goes.
    struct BodyWay {
        std::size_t first, last;  // edges, in the order of the outline
        WayAround way;
        bool left;
    };
    /// Face that the straight path grazes, or those between the corners of an edge, and the share
    /// of the reflection in the edges' field.
    struct GrazedFace {
        std::size_t face, edge;
        double share;
    };
    void propose(Vec3 to, const RayLimit* limit);
    std::optional<Candidate> plan(std::span<const std::uint32_t> chain, const RayLimit* limit);
    bool place(std::span<const std::uint32_t> chain, double flat, std::span<Vec3> points) const;
    void add(const Candidate& path, const RayLimit* limit, RayPaths& out);
    void add_diffracted(const RayLimit* limit, RayPaths& out);
    void add_around(const WayAround& way, double steps, const RayLimit* limit, RayPaths& out);
    void add_around_edge(std::size_t edge, const RayLimit* limit, RayPaths& out);
    void add_around_bodies(bool left, const RayLimit* limit, RayPaths& out);
    void pass_beside(std::size_t edge, const RayLimit* limit, RayPaths& out);
    double loss_of(const RayHit& hit, const RayMaterials& materials);
    bool is_near(const WallEdge& edge, double detour) const;
    RayHit reflection(Vec3 p, Vec3 q, std::uint32_t face) const;
    bool pass(Vec3 p, Vec3 q, double begin, double end, Draft& draft);
    static double free_space(double length, Hertz f);
    bool is_faint(const Draft& draft) const;
    void finish(const Draft& draft, bool bright, double length);
    std::optional<RayHit> crossing(const Crossing& c, Vec3 from, Vec3 along, bool whole_ends);
    std::span<const RayHit> reflections_of(const Candidate& c) const {
        return std::span(reflections_).subspan(c.first, c.count);
    }

    const Scene& scene_;
    Vec3 from_;
    std::span<const Face> faces_;
    double wavelength_;
    RayImages images_;
    RayEdges edges_;
    // Ends of the link that is traced, the first by its coordinates first; then its state:
    Vec3 a_, b_;
    double best_ = 0;  // loss of the strongest path so far [dB]
    std::vector<double> losses_;
    std::vector<Candidate> candidates_;
    std::vector<RayHit> reflections_;  // of the candidates
    std::vector<Vec3> points_;         // of the candidates
    std::vector<std::uint32_t> chain_;
    std::vector<Vec3> mirrored_;
    std::vector<Crossing> crossings_;
    std::vector<std::size_t> crossed_;  // faces of the last leg's walls
    std::vector<CrossedAt> at_edge_;    // by edge: faces in the way of the straight path
    std::vector<char> done_;            // by edge: a way has it
    std::vector<BodyWay> bodies_;       // ways around single bodies in the straight path
    std::vector<std::size_t> passed_;
    std::vector<GrazedFace> grazed_;
    std::array<KnownSlab, 6> known_{};  // the last ones, of the same materials
    std::size_t next_known_ = 0;
};

}  // namespace rovernet
