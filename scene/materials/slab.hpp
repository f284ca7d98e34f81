// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/complex_math.hpp"
#include "sim/units.hpp"

namespace rovernet {

/// Fields at a slab for a plane wave of unit field, time convention e^(+j omega t).
struct SlabFields {
    /// Transmitted field, relative to the field without the slab, without the factor e^-decay.
    math::Complex transmitted;
    /// Decay of the transmitted field [Np], >= 0: the field is e^-decay times `transmitted`. Stored
    /// separately, because a sheet of metal has thousands of decibels.
    double decay;
    /// Field reflected by the slab.
    math::Complex reflected;
};

/// Powers of the fields transmitted and reflected by a slab, without phases; faster to compute.
struct SlabPowers {
    double transmitted;  ///< |transmitted|^2
    double decay;        ///< decay of the field [Np]
    double reflected;    ///< |reflected|^2
};

/// Slab of one material at one frequency, evaluated for many thicknesses and angles. TE
/// polarisation, as from a vertical antenna at a vertical wall. Results equal those of
/// slab_losses(), except for rounding.
///
/// The slab is passive; in terms of SlabFields:
///
///   |transmitted|^2 e^(-2 decay) + |reflected|^2 <= 1
class Slab {
  public:
    Slab(ItuMaterial material, Hertz frequency);
    /// @param thickness  [m], >= 0
    /// @param cosine     cosine of the angle between the wave's direction and the normal, above 0
    ///                   to 1
    SlabFields fields(double thickness, double cosine) const;
    SlabPowers powers(double thickness, double cosine) const;
    /// Largest fraction of power that a slab of any thickness reflects [-], for a real reflection
    /// coefficient r of its face: 4 |r|^2 / (1 + |r|^2)^2. More accurate for a smaller cosine.
    double most_reflected(double cosine) const;

  private:
    double wave_number_;  // in air [rad/m]
    math::Complex permittivity_;
};

}  // namespace rovernet
