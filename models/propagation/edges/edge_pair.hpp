// SPDX-License-Identifier: MIT
#pragma once

#include "sim/complex_math.hpp"
#include "sim/units.hpp"

namespace rovernet {

/// Two edges of one body in a row, with a face between them, and a way past both: a block as wide
/// as the face is long. The way leads from an end to the first edge, along the face to the last
/// edge, and on to the other end.
struct EdgePair {
    double before, along, after;  ///< parts of the way [m], > 0
    /// What the way by the edge is longer than the straight line between its neighbours, the other
    /// edge and an end [m]; negative where the way bends away from the body: the edge is lit.
    double first, last;
};

/// Field past a wide body over that in the open [-], with its phase beyond that of the shortest
/// way around the body: a string drawn tight, which is the straight line where both edges are lit.
///
/// With y1, y2 > 0 the heights over both edges, and G the kernel of Fresnel's integral,
///
///   integral over y1, y2 of G(y1; before) [G(y2 - y1; along) - G(y2 + y1; along)] G(y2; after):
///
/// the face takes the field along it (soft, as every material does at a grazing angle), so that the
/// field has a mirrored part with the other sign. In closed form but for one smooth integral, with
/// rho = sqrt(before after / ((before + along) (along + after))), nu = 2 sqrt(bend / lambda):
///
///   U = V(pi/2 + asin rho) - V(pi/2 - asin rho),
///   V(T) = 1/(2 pi) integral from 0 to T of 1 - F(s^2) dp,
///   s = sqrt(pi/2) (nu_first sin(T - p) + nu_last sin p) / sin T,
///
/// and F the transition function of diffraction.hpp; where the ends lie in the face's plane U is
/// asin(rho) / pi. The mirrored part fades as an edge is lit, to nothing at nu = -3: from there on
/// the reflection is a path of its own, and the pair is the other edge alone.
///
/// For small angles; within 1 dB of the field behind a soft block 0.3 m to 4 m wide, 7.5 m from
/// both ends. Source: G. Millington, R. Hewitt, F. S. Immirzi, Double knife-edge diffraction in
/// field-strength predictions, Proc. IEE 109C, 1962, for two screens: V(pi/2 + asin rho) alone.
math::Complex pair_field(const EdgePair& pair, double wavelength);

/// Share of the face's reflection that pair_field() holds [-]: 1 where both edges stand in the way,
/// 0 where one is far off.
double mirrored_share(const EdgePair& pair, double wavelength);

}  // namespace rovernet
