// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/p2040.hpp"
#include "sim/complex_math.hpp"
#include "sim/units.hpp"

namespace rovernet {

/// Fields transmitted and reflected by a slab, for an incident plane wave of unit field. The time
/// convention is e^(+j omega t).
struct SlabFields {
    /// Transmitted field, relative to the field without the slab. The exponential decay inside the
    /// slab (factor e^-decay) is not included.
    math::Complex transmitted;
    /// Decay of the transmitted field [Np], >= 0: the field is e^-decay times `transmitted`. The
    /// decay is stored separately, since a sheet of metal has a decay of thousands of decibels.
    double decay;
    /// Field reflected by the slab, relative to the incident field.
    math::Complex reflected;
};

/// Powers that a slab transmits and reflects, relative to the incident power. They have no phases,
/// and are faster to compute than SlabFields.
struct SlabPowers {
    /// Transmitted power over incident power [-], without the exponential decay inside the slab
    /// (factor e^(-2 decay)): the square of |SlabFields::transmitted|.
    double transmitted;
    double decay;      ///< decay of the transmitted field (not of its power) [Np], >= 0
    double reflected;  ///< reflected over incident power [-]: |SlabFields::reflected|^2
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
    /// Fields at the slab for one thickness and angle of incidence.
    /// @param thickness  thickness of the slab [m], >= 0
    /// @param cosine     cosine of the angle between wave direction and slab normal, > 0, <= 1
    SlabFields fields(double thickness, double cosine) const;
    SlabPowers powers(double thickness, double cosine) const;
    /// Largest fraction of power that a slab of any thickness reflects [-], computed for a real
    /// reflection coefficient r of its surface: 4 |r|^2 / (1 + |r|^2)^2. The smaller the cosine of
    /// the angle of incidence, the more accurate is the result.
    double most_reflected(double cosine) const;

  private:
    double wave_number_;  // wave number of the radio wave in air [rad/m]
    math::Complex permittivity_;
};

}  // namespace rovernet
