// SPDX-License-Identifier: MIT
#pragma once

#include "sim/complex_math.hpp"
#include "sim/units.hpp"

namespace rovernet {

/// Detour around an edge [wavelengths] below which the edge affects the straight path. The detour
/// is the length of the path around the edge minus that of the straight path. With a smaller
/// detour, both paths together form one field.
inline constexpr double near_edge = 2.25;

/// Two consecutive edges of a body that a radio path passes: the edges of a block, with a face of
/// the block between them, or the edges of two screens. The path consists of three straight parts:
/// from its start to the first edge, from there (along the face) to the last edge, and from there
/// to its end.
struct EdgePair {
    /// Lengths of the three parts of the path [m], > 0: from its start to the first edge, from the
    /// first to the last edge, and from the last edge to its end.
    double before, along, after;
    /// Detours [m] of the path at the first and at the last edge: length of the path past the edge
    /// minus the straight distance of its two neighbouring points (the other edge and an end). A
    /// detour is negative if the edge does not obstruct the straight line (the edge is lit).
    double first, last;
    /// True if a face connects the edges; false for the edges of two screens.
    bool face = true;
};

/// Field past one screen, relative to free space [-], with its phase relative to that of the
/// shortest path: 1 far above the edge, 1/2 at the edge.
/// @param bend  detour [m]: length of the path by the edge minus the straight line; negative if the
///              edge does not obstruct the straight line (it is lit)
math::Complex screen_field(double bend, double wavelength);

/// Field past a wide body, relative to free space [-], with its phase relative to that of the
/// shortest path around the body: a taut string, or the straight line if neither edge obstructs it
/// (both edges are lit).
///
/// With the heights y1, y2 > 0 over the two edges, and the kernel G of Fresnel's integral,
///
///   integral over y1, y2 of G(y1; before) [G(y2 - y1; along) - G(y2 + y1; along)] G(y2; after):
///
/// The field along the face vanishes (soft face, as for every material at a grazing angle), so a
/// mirrored part has the opposite sign. In closed form except for one smooth integral, with
/// rho = sqrt(before after / ((before + along) (along + after))), and nu = 2 sqrt(d / lambda) for
/// the detour d at each edge (`first`, `last`), with the sign of d:
///
///   U = V(pi/2 + asin rho) - V(pi/2 - asin rho),
///   V(T) = 1/(2 pi) integral from 0 to T of 1 - F(s^2) dp,
///   s = sqrt(pi/2) (nu_first sin(T - p) + nu_last sin p) / sin T,
///
/// and F the transition function of diffraction.hpp; if both ends lie in the face's plane, U is
/// asin(rho) / pi. The mirrored part decreases as an edge becomes lit, to 0 at nu = -3; beyond that
/// the reflection is a separate path, and the pair acts as the other edge alone.
///
/// Without a face there is no mirrored part.
///
/// Valid for small angles; within 1 dB of the field behind a soft block 0.3 m to 4 m wide, 7.5 m
/// from both ends. Source: G. Millington, R. Hewitt, F. S. Immirzi, Double knife-edge diffraction
/// in field-strength predictions, Proc. IEE 109C, 1962, for two screens: V(pi/2 + asin rho) alone.
math::Complex pair_field(const EdgePair& pair, double wavelength);

/// Fraction [-] of the reflection by the face between two edges that pair_field() already includes:
/// 1 if both edges obstruct the path, 0 if one edge is far away.
double mirrored_share(const EdgePair& pair, double wavelength);

}  // namespace rovernet
