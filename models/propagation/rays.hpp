// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "models/propagation/ray_path.hpp"
#include "scene/materials/p2040.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rovernet {

/// How a model of rays adds the paths of a link.
enum class RaySum {
    power,    ///< powers: the mean over places within some wavelengths
    coherent  ///< fields with their phases: one place, with its fading. The faces of a wall across
              ///< the cells of a map are some centimetres off: 3 to 5 dB (rms) at 2.4 GHz
};
/// Words of `sum` in files.
template <>
struct EnumNames<RaySum> {
    static constexpr std::array<std::string_view, 2> values = {"power", "coherent"};
};

/// Rays: the straight path through the walls, those that up to `order` walls reflect, and those
/// around edges. With L_i the loss of path i [dB], of length d_i [m]:
///
///   L = -10 log10 sum 10^(-L_i / 10),     or     L = -20 log10 |sum 10^(-L_i / 20) e^(j phi_i)|
///   L_i = 20 log10(4 pi d_i f / c) + losses of crossings, reflections and edges,
///   phi_i = -2 pi d_i f / c + their phases
///
/// Walls are the scene's faces, see Faces: a wall drawn at 30 degrees reflects at 30 degrees. Faces
/// shorter than a wavelength reflect nothing, and neither do floors and ceilings. A material of
/// ITU-R P.2040 transmits and reflects as a slab at the path's angle (the electric field along the
/// wall, as of upright antennas); one that gives decibels takes those, and reflects all but
/// `reflection_loss`; one that follows the model is a slab of `wall`, as thick as drawn, at most
/// half a metre.
///
/// Edges: `knife_edge` takes J(nu) of ITU-R P.526 from a path around a wall that stands in the
/// straight path, and up to 6 dB from a straight path that passes near an edge. Two edges of one
/// body in a row are a pair, see pair_field(). `utd` is the
/// uniform theory of diffraction; the straight path and those around edges are then one field, so
/// that nothing jumps at the border of a wall's shadow. See RayTracer and RayEdges for which edges.
///
/// The strongest `max_paths` paths are added, of those within 30 dB of the strongest one: what is
/// left out by the latter adds less than 1e-3 of the power each. With phases, a sum is cut at 40 dB
/// below that of the powers; that of the straight path and edges also at 3 dB above it.
///
/// The loss is anything but monotone, and jumps where a path begins or ends: at the border of a
/// wall's shadow by what the wall takes (not with edges), at the end of a mirror by what it adds.
///
/// No link loses more than 200 dB over free space.
///
/// Paths are planned in plan and do not know storeys: a scene of several is refused.
///
/// Without walls it is free space. Source: the theory of images, for instance H. L. Bertoni, Radio
/// Propagation for Modern Wireless Systems, 2000, chapter 3; slabs: ITU-R P.2040-3; edges:
/// ITU-R P.526-15 and Kouyoumjian and Pathak 1974, see diffraction.hpp.
struct Rays {
    static constexpr std::string_view name = "rays";

    /// Most reflections of a path [-], 0 to 3.
    int order = 2;
    /// Ways around edges of walls.
    RayDiffraction diffraction = RayDiffraction::knife_edge;
    /// How paths are added.
    RaySum sum = RaySum::power;
    /// Material of walls that follow the model.
    ItuMaterial wall = ItuMaterial::concrete;
    /// Loss of a crossing of such a wall [dB], >= 0, at any angle: then it is no slab of `wall`,
    /// but as a material that is given in decibels. A fit finds it.
    std::optional<Db> wall_loss = std::nullopt;
    /// Loss of a reflection [dB], >= 0, of a material whose losses are given in decibels.
    Db reflection_loss{6};
    /// Most paths that are added, the strongest ones, 1 to 1000.
    int max_paths = 16;

    static constexpr auto fields() {
        return describe(
            field("order", &Rays::order, Range{.low = 0, .high = 3, .text = "from 0 to 3"},
                  "most reflections of a path"),
            field("diffraction", &Rays::diffraction,
                  "ways around edges of walls: none, knife_edge or utd"),
            field("sum", &Rays::sum,
                  "power, the local mean; or coherent, one place with its fading, 3 to 5 dB off "
                  "(rms) where walls are not along the cells"),
            field("wall", &Rays::wall, "what walls are made of whose material gives no loss"),
            field("wall_loss", &Rays::wall_loss, non_negative,
                  "loss of a crossing of such a wall, in place of what `wall` takes"),
            field("reflection_loss", &Rays::reflection_loss, non_negative,
                  "loss of a reflection by a material that is given in dB"),
            field("max_paths", &Rays::max_paths,
                  Range{.low = 1, .high = 1000, .text = "from 1 to 1000"},
                  "most paths that are added, the strongest ones"));
    }

    LossShape shape() const { return LossShape::unknown; }

    /// Checks a scene. @throws std::invalid_argument if it has several storeys
    void check_scene(const Scene& scene) const;

    /// Distance [m] beyond which the loss is more than `loss`: no path is shorter than the straight
    /// one or stronger than in free space. So P paths add at most 10 log10 P dB to free space, 3 dB
    /// more with utd, and 20 log10 P dB if they are coherent. P is max_paths, or 1 if there is but
    /// the straight path.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] [dB] for the i-th receiver; walls come from the batch's scene.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;

    /// Paths of a link, as they are found, and of them those that `max_paths` leaves out.
    struct Paths {
        std::size_t found, left_out;
        Db too_high;  ///< the loss is higher by this for what is left out, by power
    };
    /// @param link  batch of one receiver
    Paths paths(const LinkBatch& link) const;
};

}  // namespace rovernet
