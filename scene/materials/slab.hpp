// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/complex_math.hpp"
#include "sim/units.hpp"

namespace rovernet {

/// Fields that a slab makes of a plane wave of unit field, time convention e^(+j omega t).
struct SlabFields {
    /// Field behind the slab over that which would be there without it, but for the decay.
    math::Complex transmitted;
    /// Decay of the transmitted field [Np], >= 0: it is e^-decay of `transmitted`. Apart, since a
    /// sheet of metal takes thousands of decibels.
    double decay;
    /// Field reflected at the slab's face.
    math::Complex reflected;
};

/// Powers of the same fields, without their phases: cheaper.
struct SlabPowers {
    double transmitted;  ///< |transmitted|^2
    double decay;        ///< [Np], of the field
    double reflected;    ///< |reflected|^2
};

/// Slabs of one material at one frequency, for many thicknesses and angles; for the polarisation
/// TE, that of an upright antenna before an upright wall. The equations are those of slab_losses(),
/// and so are the decibels, to rounding.
///
///   |transmitted|^2 e^(-2 decay) + |reflected|^2 <= 1
class Slab {
  public:
    Slab(ItuMaterial material, Hertz frequency);
    /// @param thickness  [m], >= 0
    /// @param cosine     of the angle between the wave's way and the normal, above 0 to 1
    SlabFields fields(double thickness, double cosine) const;
    SlabPowers powers(double thickness, double cosine) const;
    /// Most that a slab of any thickness reflects [-]: 4 |r|^2 / (1 + |r|^2)^2, with the reflection
    /// coefficient r of its face; the better, the smaller the cosine. Of power, for real r.
    double most_reflected(double cosine) const;

  private:
    double wave_number_;  // in air [rad/m]
    math::Complex permittivity_;
};

}  // namespace rovernet
