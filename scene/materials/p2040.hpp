// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace rovernet {

/// Building materials of Recommendation ITU-R P.2040.
enum class ItuMaterial : std::uint8_t {
    concrete,
    brick,
    plasterboard,
    wood,
    glass,
    ceiling_board,
    chipboard,
    plywood,
    marble,
    floorboard,
    metal,
};
template <>
struct EnumNames<ItuMaterial> {
    static constexpr std::array<std::string_view, 11> values = {
        "concrete",  "brick",   "plasterboard", "wood",       "glass", "ceiling_board",
        "chipboard", "plywood", "marble",       "floorboard", "metal"};
};

/// Electrical properties at one frequency.
struct Permittivity {
    double real;       ///< relative permittivity eps_r [-]
    double imaginary;  ///< sigma / (2 pi f eps_0) [-], > 0 for a lossy material
};

/// eps_r = a f^b and sigma = c f^d [S/m], f in GHz; beyond the table's range (1-100 GHz for most)
/// the law is extrapolated. Source: ITU-R P.2040-3, table 3 and eq. 28.
Permittivity permittivity(ItuMaterial material, Hertz frequency);

/// What a flat slab in air takes from a plane wave [dB], reflections inside included: of the wave
/// that passes through, and of the one that comes back. TE: the electric field stands across the
/// plane of incidence, as that of an upright antenna before an upright wall; TM: it lies in it.
struct SlabLosses {
    Db te_transmission, tm_transmission;
    Db te_reflection, tm_reflection;
};

/// Losses of a slab at an angle. Those of transmission are finite for any thickness; what does not
/// reflect, a slab of thickness 0 say, has an infinite loss of reflection.
/// Source: ITU-R P.2040-3, eqs. 37, 43 and 44.
/// @param thickness  [m], >= 0
/// @param incidence  angle between the wave's way and the normal [rad], from 0 to pi / 2
SlabLosses slab_losses(ItuMaterial material, Meters thickness, Hertz frequency, Radians incidence);

/// Transmission loss [dB] of a slab at normal incidence, see slab_losses().
Db slab_loss(ItuMaterial material, Meters thickness, Hertz frequency);

}  // namespace rovernet
