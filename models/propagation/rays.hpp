// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "scene/materials/p2040.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rovernet {

/// Method of computing the diffraction around edges of walls.
enum class RayDiffraction {
    none,
    knife_edge,  ///< edges of opaque screens
    utd          ///< wedges, by the uniform theory of diffraction
};
/// Names of the values of `diffraction` in scenario files.
template <>
struct EnumNames<RayDiffraction> {
    static constexpr std::array<std::string_view, 3> values = {"none", "knife_edge", "utd"};
};

/// Method of adding the paths of a link: sum of their powers or of their fields.
enum class RaySum {
    power,    ///< sum of powers: the mean over positions within some wavelengths
    coherent  ///< sum of fields with phases: the value at one place, with fading. On a map, the
              ///< faces of a slanting wall are inaccurate by some centimetres: 3 to 5 dB (rms) at
              ///< 2.4 GHz
};
/// Names of the values of `sum` in scenario files.
template <>
struct EnumNames<RaySum> {
    static constexpr std::array<std::string_view, 2> values = {"power", "coherent"};
};

/// Ray tracing: the straight path through the walls, paths with up to `order` reflections, and
/// paths around edges. With the loss L_i [dB] and the length d_i [m] of path i:
///
///   L = -10 log10 sum 10^(-L_i / 10),     or     L = -20 log10 |sum 10^(-L_i / 20) e^(j phi_i)|
///   L_i = 20 log10(4 pi d_i f / c) + losses of crossings, reflections and edges,
///   phi_i = -2 pi d_i f / c + their phases
///
/// Walls are the scene's faces, see Faces: a wall drawn at 30 degrees reflects at 30 degrees. Faces
/// shorter than a wavelength do not reflect, and neither do floors and ceilings. A material of
/// ITU-R P.2040 transmits and reflects as a slab at the path's angle (electric field parallel to
/// the wall, as for vertical antennas). A material with a loss in decibels has that loss for
/// crossings, and `reflection_loss` for reflections. A material without a loss is a slab of `wall`
/// with the drawn thickness, at most half a metre.
///
/// Edges: with `knife_edge`, a path around a wall in the straight path loses J(nu) of ITU-R P.526,
/// and a straight path that passes near an edge loses up to 6 dB. Two consecutive edges of one body
/// are a pair, see pair_field(). With `utd`, the uniform theory of diffraction, the straight path
/// and the paths around edges form one field without a jump at a shadow boundary. RayTracer and
/// RayEdges describe which edges count.
///
/// The sum contains the strongest `max_paths` paths that are within 30 dB of the strongest one;
/// each weaker path would add less than 1e-3 of the power. A coherent sum is never more
/// than 40 dB below the sum of powers; the sum of the straight path and edges is also never more
/// than 3 dB above it.
///
/// The loss is not a monotone function of distance, and jumps where a path begins or ends: at a
/// wall's shadow boundary by the loss of the wall (not with edges), at the end of a reflecting face
/// by the reflected power.
///
/// The loss is at most 200 dB above free space.
///
/// Paths are found in the horizontal plane. It is an error if the scene has several storeys.
///
/// Without walls the loss is that of free space. Source: the method of images, for instance H. L.
/// Bertoni, Radio Propagation for Modern Wireless Systems, 2000, chapter 3; slabs: ITU-R P.2040-3;
/// edges: ITU-R P.526-15 and Kouyoumjian and Pathak 1974, see diffraction.hpp.
struct Rays {
    static constexpr std::string_view name = "rays";
    static constexpr bool is_indoor = true;

    /// Largest number of reflections of a path [-], 0 to 3.
    int order = 2;
    /// Method of computing the diffraction around edges of walls: none, knife edges or wedges.
    RayDiffraction diffraction = RayDiffraction::knife_edge;
    /// Method of adding the paths of a link: sum of their powers or of their fields.
    RaySum sum = RaySum::power;
    /// Material of walls whose material in the scene has no loss.
    ItuMaterial wall = ItuMaterial::concrete;
    /// Loss of crossing a wall whose material has no loss of its own [dB], >= 0, at any angle. A
    /// given `wall_loss` replaces the slab of `wall`. `rovernet fit` estimates this parameter.
    std::optional<Db> wall_loss = std::nullopt;
    /// Loss of a reflection [dB], >= 0, by a material with a loss in decibels.
    Db reflection_loss{6};
    /// Largest number of paths in the sum, 1 to 1000; the strongest are used.
    int max_paths = 16;

    static constexpr auto fields() {
        return describe(
            field("order", &Rays::order, Range{.low = 0, .high = 3, .text = "from 0 to 3"},
                  "largest number of reflections of a path"),
            field("diffraction", &Rays::diffraction,
                  "how paths around edges of walls are computed: none (no such paths), knife_edge "
                  "or utd"),
            field("sum", &Rays::sum,
                  "power: the powers of the paths are added, which gives the local mean of the "
                  "level; coherent: the waves are added with their phases, which gives the level "
                  "at one place, with errors of 3 to 5 dB (rms) where walls are not parallel to "
                  "the cells of the map"),
            field("wall", &Rays::wall, "material of walls for which the scenario gives no loss"),
            field("wall_loss", &Rays::wall_loss, non_negative,
                  "loss each time that a path crosses a wall for which the scenario gives no loss; "
                  "used instead of the loss of the material `wall`")
                .searched(10),
            field("reflection_loss", &Rays::reflection_loss, non_negative,
                  "loss of a reflection by a wall whose material has a loss in dB")
                .searched(6),
            field("max_paths", &Rays::max_paths,
                  Range{.low = 1, .high = 1000, .text = "from 1 to 1000"},
                  "largest number of paths that are added; if there are more, the strongest paths "
                  "are used"));
    }

    /// Forms of the model from the cheapest to the most detailed one, for `rovernet advise`.
    static std::array<Rays, 4> forms() {
        return {{{.order = 1, .diffraction = RayDiffraction::none},
                 {.order = 2, .diffraction = RayDiffraction::knife_edge},
                 {.order = 2, .diffraction = RayDiffraction::utd},
                 {.order = 3, .diffraction = RayDiffraction::utd}}};
    }

    LossShape shape() const { return LossShape::unknown; }

    /// Checks a scene. @throws std::invalid_argument if it has several storeys
    void check_scene(const Scene& scene) const;

    /// Distance [m] beyond which the loss is more than `loss`. Every path is at least as long as
    /// the straight path, and at most as strong as in free space. Therefore P paths are at most
    /// 10 log10 P dB stronger than free space, 3 dB more with utd, and 20 log10 P dB if coherent. P
    /// is max_paths, or 1 if only the straight path is traced.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i; walls come from the batch's scene.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;

    /// Number of paths found for a link, and number of paths left out of the sum by `max_paths`.
    struct Paths {
        std::size_t found, left_out;
        Db too_high;  ///< error of the loss [dB] by the omitted paths, if powers are added
    };
    /// @param link  batch of links with one receiver
    Paths paths(const LinkBatch& link) const;
};

}  // namespace rovernet
