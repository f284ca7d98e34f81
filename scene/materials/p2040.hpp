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
/// Names of the materials in scenario files.
template <>
struct EnumNames<ItuMaterial> {
    static constexpr std::array<std::string_view, 11> values = {
        "concrete",  "brick",   "plasterboard", "wood",       "glass", "ceiling_board",
        "chipboard", "plywood", "marble",       "floorboard", "metal"};
};

/// Electrical properties of a material at one frequency.
struct Permittivity {
    double real;       ///< relative permittivity eps_r [-]
    double imaginary;  ///< sigma / (2 pi f eps_0) [-], > 0 for a lossy material
};

/// Complex relative permittivity of a material: eps_r = a f^b and conductivity sigma = c f^d [S/m],
/// with f in GHz and the constants a to d of the source's table. Values are extrapolated beyond the
/// table's range (1-100 GHz for most materials). Source: ITU-R P.2040-3, table 3 and eq. 28.
Permittivity permittivity(ItuMaterial material, Hertz frequency);

/// Losses [dB] of a plane wave at a flat slab in air, for the transmitted and for the reflected
/// wave; reflections inside the slab are included. TE: the electric field is perpendicular to the
/// plane of incidence, as from a vertical antenna at a vertical wall. TM: parallel to that plane.
struct SlabLosses {
    Db te_transmission, tm_transmission;
    Db te_reflection, tm_reflection;
};

/// Losses of a slab at an angle of incidence. Transmission losses are finite for any thickness; the
/// reflection loss is infinite if nothing is reflected, as for thickness 0.
/// Source: ITU-R P.2040-3, eqs. 37, 43 and 44.
/// @param thickness  [m], >= 0
/// @param incidence  angle between the wave's direction and the normal [rad], from 0 to pi / 2
SlabLosses slab_losses(ItuMaterial material, Meters thickness, Hertz frequency, Radians incidence);

/// Transmission loss [dB] of a slab at normal incidence, see slab_losses().
Db slab_loss(ItuMaterial material, Meters thickness, Hertz frequency);

}  // namespace rovernet
