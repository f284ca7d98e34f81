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

/// Transmission loss [dB] of a flat slab in air at normal incidence: reflections inside included.
/// Finite for any thickness >= 0 [m]. Source: ITU-R P.2040-3, eqs. 43 and 44.
Db slab_loss(ItuMaterial material, Meters thickness, Hertz frequency);

}  // namespace rovernet
