// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/ray_path.hpp"
#include "models/propagation/rays.hpp"
#include "scene/materials/material.hpp"
#include "scene/materials/slab.hpp"
#include "sim/complex_math.hpp"
#include "sim/units.hpp"

#include <array>
#include <optional>
#include <vector>

namespace rovernet {

/// Factor by which a wall changes the field of a path: `field` times e^-decay.
struct RayFactor {
    math::Complex field;
    /// Exponential decay inside the wall [Np], >= 0; not part of `field`, which would be 0 for
    /// metal.
    double decay;

    double loss() const;  ///< loss of the wall for the path [dB], finite
};

/// Losses at a slab [dB]: loss of the transmitted wave, and loss of the reflected wave.
struct HitLosses {
    double crossing, reflection;
};

/// Upper limit for the thickness of a wall without a given material: no wall of a building is
/// thicker. Thicker drawn objects are furniture, pillars or shafts, which are not solid.
inline constexpr Meters thickest_default_wall{0.5};

/// Coefficients of a scene's materials at one frequency.
///
/// A material of ITU-R P.2040 is a slab of its own thickness, at the path's angle, in TE
/// polarisation. A material without a loss of its own is a slab of the model's `wall` material with
/// the drawn thickness, at most `thickest_default_wall`, or has the loss `wall_loss`. A material
/// with a loss in decibels attenuates the transmitted wave by that loss at any angle, without a
/// phase shift, and reflects with the model's `reflection_loss` and a phase shift of pi.
class RayMaterials {
  public:
    /// @param wall_loss  loss of crossing a wall whose material has no loss; empty: such a wall is
    ///                   a slab of `wall`
    RayMaterials(const std::vector<Material>& materials, Hertz frequency, ItuMaterial wall,
                 std::optional<Db> wall_loss, Db reflection_loss);
    RayFactor factor(const RayHit& hit) const;
    /// Whether the material is a slab: its loss depends on thickness and angle, not on the length
    /// inside the wall.
    bool is_slab(std::size_t material) const { return entries_[material].slab.has_value(); }
    /// Losses of a slab [dB], equal to the losses of factor() except for rounding.
    HitLosses losses_at_slab(std::size_t material, double thickness, double cosine) const;
    /// Lower bound of the reflection loss [dB] of the material at this angle, for any thickness.
    double least_reflection_loss(std::size_t material, double cosine) const;
    /// Field around an edge, relative to free space at the same path length.
    ///
    /// knife_edge: J(nu) of P.526, nu = 2 sqrt(detour / lambda), applied to the part of the power
    /// that the wall does not transmit. utd: D sqrt((s + s') / (s s')), with D of
    /// wedge_coefficient(), the distances s' and s from the edge to the ends of the path, the
    /// wall's transmission into its shadow, and its reflection if `mirrors`. A pair of edges:
    /// pair_field(). The magnitude of the field is at most 1.
    /// @param mirrors  whether reflected paths are added with their phases
    RayFactor around(const RayEdge& edge, RayDiffraction by, bool mirrors) const;
    /// Loss [dB] of a straight path that passes near an edge but is not obstructed by it, for knife
    /// edges. The loss is up to 6 dB at one edge, and applies to the part of the power that the
    /// wall at the edge does not transmit.
    double beside_edge(const RayEdge& edge) const;

  private:
    math::Complex through(const RayEdge& edge) const;
    RayFactor reflected(std::size_t material, double thickness, double cosine) const;
    RayFactor crossed(std::size_t material, double thickness, double cosine, double length) const;

  private:
    struct Entry {
        std::optional<Slab> slab;         // empty for a material with a loss in decibels
        std::optional<double> thickness;  // fixed thickness [m], instead of the drawn one
        double thickest;                  // upper limit of the drawn thickness [m]
        std::array<double, 65> least;     // smallest reflection loss [dB], by 64 * cosine
        double per_crossing, per_metre;   // losses of a crossing [dB], [dB/m]

        double slab_thickness(double drawn) const {
            return thickness.value_or(drawn < thickest ? drawn : thickest);
        }
    };
    double wavelength_;
    std::vector<Entry> entries_;
    double mirror_;  // reflection coefficient of materials with a loss in decibels
};

}  // namespace rovernet
