// SPDX-License-Identifier: MIT
#pragma once

#include "sim/complex_math.hpp"
#include "sim/units.hpp"

// Diffraction at one edge: as a loss in decibels at a screen, as a field at a wedge. Time
// convention of all fields: e^(+j omega t), so that a travelling wave is e^(-j k s).

namespace rovernet {

/// Loss of a single knife edge [dB] in the path of a wave:
///
///   J(nu) = -20 log10( sqrt((1 - C - S)^2 + (C - S)^2) / 2 ),
///   nu = h sqrt(2 (d1 + d2) / (lambda d1 d2)),
///
/// with the Fresnel integrals C and S of nu, the edge's height h [m] above the straight line, its
/// distances d1 and d2 [m] from the ends of the line, and the wavelength lambda [m]. The loss is
/// 6.02 dB if the edge touches the line; for edges below the line it may be negative, a gain of up
/// to 1.4 dB. Valid for any nu; the loss is infinite for infinite nu.
/// Source: Recommendation ITU-R P.526-15, section 4.1, equations 26 and 30.
double knife_edge_loss_db(double nu);

/// Loss of a single knife edge [dB], approximated by Recommendation ITU-R P.526-15, equation 31:
///
///   J(nu) = 6.9 + 20 log10( sqrt((nu - 0.1)^2 + 1) + nu - 0.1 ) for nu > -0.78, else 0
///
/// The approximation is within 0.13 dB of knife_edge_loss_db() for nu > -0.78, and neglects the
/// oscillation for smaller nu. Its step at nu = -0.78 is 0.004 dB; without the limit the
/// approximation would be an unbounded gain.
double knife_edge_loss_p526_db(double nu);

/// Transition function F(x) [-] of the uniform theory of diffraction, for x >= 0:
///
///   F(x) = 2 j sqrt(x) e^(j x) times the integral of e^(-j t^2) dt from sqrt(x) to infinity
///
/// F is 0 at 0 and tends to 1. Absolute error below 1e-14. Source: R. G. Kouyoumjian and P. H.
/// Pathak, A uniform geometrical theory of diffraction for an edge in a perfectly conducting
/// surface, Proc. IEEE 62(11), 1974.
math::Complex transition_function(double x);

/// Path of a wave over the edge of a wedge, seen along the edge.
struct WedgePath {
    double n;  ///< exterior angle of the wedge over pi [-]: 2 a screen, 1.5 a right-angled corner
    Radians phi;           ///< direction to the receiver [rad], from face 0: 0 to n pi
    Radians phi_incident;  ///< direction to the source [rad], from face 0: 0 to n pi
};

/// Rays of geometrical optics that reach a receiver near a wedge, see WedgePath for the angles.
struct LitBy {
    /// Whether the straight ray reaches the receiver: |phi - phi_incident| <= pi.
    bool direct;
    /// Whether the reflection by face 0 reaches the receiver: phi + phi_incident <= pi.
    bool face_0;
    /// Whether the reflection by face n reaches the receiver: phi + phi_incident >= (2 n - 1) pi.
    bool face_n;
};
/// Rays of geometrical optics that reach the receiver of a path around a wedge, from the angles of
/// the path.
LitBy lit_by(const WedgePath& path);

/// Coefficients of a wedge's faces [-]: ratios of fields to the incident field.
struct WedgeFaces {
    math::Complex face_0;      ///< reflection by face 0
    math::Complex face_n;      ///< reflection by face n
    math::Complex through{0};  ///< transmission into the shadow; 0 for an opaque wedge
};
/// Coefficients of faces at which the field is 0 (soft), or at which its normal derivative is 0
/// (hard). A metal wedge is soft for an electric field parallel to its edge, and hard for an
/// electric field perpendicular to its edge.
inline constexpr WedgeFaces soft_faces{-1, -1};
inline constexpr WedgeFaces hard_faces{1, 1};

/// Angles of incidence for the reflection coefficients of a lossy wedge's faces: from the grazing
/// angles min(phi, phi') for face 0 and n pi - max(phi, phi') for face n, with phi and phi'
/// (phi_incident) of WedgePath.
///
/// Luebbers uses phi' for face 0 and n pi - phi for face n, so that exchanging source and receiver
/// changes the result. With the smaller angle the coefficient is reciprocal; at the boundary where
/// the reflected ray of a face appears (phi + phi' = pi at face 0) it equals that ray's
/// coefficient, because sin(phi) = sin(phi').
struct FaceIncidence {
    Radians face_0, face_n;  ///< [rad] 0 (perpendicular to the face) to pi / 2 (parallel)
};
FaceIncidence face_incidence(const WedgePath& path);

/// Diffraction coefficient D of a wedge [sqrt(m)]: the diffracted field is u D A e^(-j k s), with
/// the incident field u at the edge, and the spreading factor A = 1 / sqrt(s) for a plane or
/// cylindrical wave, A = sqrt(s' / (s (s + s'))) for a spherical one; s' [m] is the distance from
/// the source to the edge, s [m] from the edge to the receiver.
///
///   D = -e^(-j pi/4) / (2 n sqrt(2 pi k))
///       [ (1 - T) (K(pi - b) + K(pi + b)) + R0 K(pi - c) + Rn K(pi + c) ],
///   b = |phi - phi'|,   c = phi + phi',   K(e) = cot(e / 2n) F(2 k L sin^2(e / 2)),
///
/// with phi, phi' (phi_incident) and n of `path`, the coefficients R0, Rn and T (face_0, face_n and
/// through) of `faces`, the transition function F, and e reduced by the multiple of 2 pi n that
/// leaves it nearest to 0.
///
/// A ray of geometrical optics appears where e = 0, and K has a step there of the size of that ray.
/// The sign of K is taken from `lit`: the sum with the rays of the same `lit` has no step, also on
/// the boundary. If the wedge transmits a part T, the field in the shadow contains T times the
/// direct ray.
///
/// Exact for a soft or hard screen in a plane wave; within 0.05 dB of the field of a right-angled
/// wedge from a distance of 10 / k on. R0, Rn and T of a lossy wedge are a heuristic, inaccurate in
/// deep shadow.
/// Source: Kouyoumjian and Pathak 1974, with a = 2 sin^2(e / 2); R0 and Rn: R. J. Luebbers, Finite
/// conductivity uniform GTD versus knife edge diffraction, IEEE Trans. Antennas Propag.
/// 32(1), 1984; T: W. D. Burnside and K. W. Burgener, High frequency scattering by a thin lossless
/// dielectric slab, IEEE Trans. Antennas Propag. 31(1), 1983.
///
/// @param path  1 <= n <= 2
/// @param k     wave number 2 pi / lambda [rad/m], > 0
/// @param L     distance parameter [m], >= 0: s for a plane wave, s s' / (s + s') for others
/// @param lit   rays that reach the receiver: lit_by(path), or by the caller's geometry, which may
///              differ from lit_by(path) only at a boundary
math::Complex wedge_coefficient(const WedgePath& path, double k, Meters L, const WedgeFaces& faces,
                                LitBy lit);
inline math::Complex wedge_coefficient(const WedgePath& path, double k, Meters L,
                                       const WedgeFaces& faces) {
    return wedge_coefficient(path, k, L, faces, lit_by(path));
}

}  // namespace rovernet
