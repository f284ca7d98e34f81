// SPDX-License-Identifier: MIT
#pragma once

// Fresnel integrals: the mathematics of diffraction at an edge.

namespace rovernet::math {

/// Auxiliary functions f and g of the Fresnel integrals [-], for t >= 0:
///
///   g - j f = e^(j pi t^2 / 2) times the integral of e^(-j pi u^2 / 2) du from t to infinity
///
/// f and g fall smoothly, from 1/2 at 0 to f = 1 / (pi t) and g = 1 / (pi^2 t^3) for large t.
/// Unlike C and S they do not oscillate, and no nearly equal numbers are subtracted. Relative error
/// below 2e-14. f and g give the complementary error function on a diagonal of the complex plane:
/// g - j f = (1 - j) / 2 e^(z^2) erfc(z) with z = sqrt(pi) / 2 (1 + j) t.
///
/// Source: NIST Digital Library of Mathematical Functions, 7.2(iv) and 7.12(ii).
struct FresnelTail {
    double f, g;
};
FresnelTail fresnel_tail(double t);

/// Fresnel integrals C and S [-]: integrals from 0 to x of cos(pi u^2 / 2) and sin(pi u^2 / 2) du.
///
/// Odd in x, 1/2 at infinity. Absolute error below 1e-15 for every x, as the phase pi x^2 / 2 is
/// reduced exactly. Source: NIST Digital Library of Mathematical Functions, 7.2(iii), 7.5.3 and
/// 7.5.4.
struct Fresnel {
    double c, s;
};
Fresnel fresnel(double x);

}  // namespace rovernet::math
