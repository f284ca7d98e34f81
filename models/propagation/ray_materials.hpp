// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/ray_path.hpp"
#include "scene/materials/material.hpp"
#include "scene/materials/slab.hpp"
#include "sim/complex_math.hpp"
#include "sim/units.hpp"

#include <array>
#include <optional>
#include <vector>

namespace rovernet {

/// What a wall makes of the field of a path: its factor is `field` times e^-decay.
struct RayFactor {
    math::Complex field;
    /// [Np], >= 0: apart from the field, which metal would make 0.
    double decay;

    double loss() const;  ///< [dB], finite
};

/// Losses of a wave that meets a slab [dB]: of what passes through it, and of what it reflects.
struct HitLosses {
    double crossing, reflection;
};

/// Largest thickness of a wall whose material is not given: no wall of a building is thicker than
/// half a metre. What is drawn so is furniture, a pillar or a shaft, which is not solid.
inline constexpr Meters thickest_default_wall{0.5};

/// Coefficients of a scene's materials at one frequency.
///
/// A material of ITU-R P.2040 is a slab of its own thickness, at the path's angle, in the
/// polarisation TE. One that follows the model is a slab of the model's `wall`, as thick as it is
/// drawn, at most `thickest_default_wall`, or takes its `wall_loss`. One that gives decibels takes
/// those from what passes, whatever the angle, without a turn of the phase, and reflects all but
/// the model's `reflection_loss`, with a turn by half a wave.
class RayMaterials {
  public:
    /// @param wall_loss  of a crossing of a wall that follows the model; none: it is a slab of
    /// `wall`
    RayMaterials(const std::vector<Material>& materials, Hertz frequency, ItuMaterial wall,
                 std::optional<Db> wall_loss, Db reflection_loss);
    RayFactor factor(const RayHit& hit) const;
    /// The material is a slab: what it takes depends on thickness and angle, not on a length.
    bool is_slab(std::size_t material) const { return entries_[material].slab.has_value(); }
    /// Losses of a slab: those of the factors of such hits, to rounding.
    HitLosses losses_at_slab(std::size_t material, double thickness, double cosine) const;
    /// Loss that no reflection by the material at that angle falls short of [dB].
    double least_reflection_loss(std::size_t material, double cosine) const;
    /// Field around an edge over that in free space at the way's length.
    ///
    /// knife_edge: J(nu) by P.526, nu = 2 sqrt(detour / lambda), of that part of the power which
    /// the wall does not let through. utd: D sqrt((s + s') / (s s')), with the wall's own
    /// transmission into its shadow, and its reflection if `mirrors`. A pair of edges:
    /// pair_field(). At most 1.
    /// @param mirrors  paths that faces reflect are added with their phases
    RayFactor around(const RayEdge& edge, RayDiffraction by, bool mirrors) const;
    /// Loss of a straight path that passes an edge on its lit side [dB], with knife edges: up to
    /// 6 dB beside one edge, of that part of the power which its wall would not let through.
    double beside_edge(const RayEdge& edge) const;

  private:
    math::Complex through(const RayEdge& edge) const;
    RayFactor reflected(std::size_t material, double thickness, double cosine) const;
    RayFactor crossed(std::size_t material, double thickness, double cosine, double length) const;

  private:
    struct Entry {
        std::optional<Slab> slab;         // or decibels
        std::optional<double> thickness;  // [m], instead of the drawn one
        double thickest;                  // [m], of the drawn one
        std::array<double, 65> least;     // loss of reflection [dB], by cosine * 64
        double per_crossing, per_metre;   // [dB], [dB/m]

        double slab_thickness(double drawn) const {
            return thickness.value_or(drawn < thickest ? drawn : thickest);
        }
    };
    double wavelength_;
    std::vector<Entry> entries_;
    double mirror_;  // reflection of materials that give decibels
};

}  // namespace rovernet
