// SPDX-License-Identifier: MIT
#include "models/propagation/edges/diffraction.hpp"

#include "models/propagation/edges/fresnel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rovernet {
namespace {

using math::Complex;
using std::numbers::pi;

/// Complex tail f + j g: the transition function is sqrt(2 pi x) times the tail at t = sqrt(2 x /
/// pi).
Complex tail(double t) {
    const auto [f, g] = math::fresnel_tail(t);
    return {f, g};
}

/// Boundary term cot(e / 2n) F(2 k L sin^2(e / 2)), with the sign of e as an argument.
///
/// cot and F are not computed separately: F is |sin(e / 2)| times a smooth function, and |sin(e /
/// 2)| / sin(e / 2n) is finite, n at e = 0.
Complex boundary_term(double e, bool positive, double n, double kL) {
    const double size = std::abs(e);
    const double sine = math::sincos(size / 2).sin;
    const auto [sine_n, cosine_n] = math::sincos(size / (2 * n));
    const double ratio = size == 0 ? n : std::abs(sine) / sine_n;
    const double t = 2 * std::sqrt(kL / pi) * std::abs(sine);
    const double factor = ratio * cosine_n * (2 * std::sqrt(pi * kL));
    return (positive ? factor : -factor) * tail(t);
}

/// Angles e = pi - beta and e = pi + beta, each reduced to the value nearest to 0, and whether 2 n
/// pi was subtracted.
struct Deviations {
    double minus, plus;
    bool minus_turned, plus_turned;
};
Deviations deviations(double beta, double n) {
    const double turn = 2 * pi * n;
    const bool minus_turned = pi - beta<-n * pi, plus_turned = pi + beta> n * pi;
    return {pi - beta + (minus_turned ? turn : 0), pi + beta - (plus_turned ? turn : 0),
            minus_turned, plus_turned};
}

Deviations difference(const WedgePath& path) {
    return deviations(std::abs(path.phi.value - path.phi_incident.value), path.n);
}
Deviations sum(const WedgePath& path) {
    return deviations(path.phi.value + path.phi_incident.value, path.n);
}

/// Angle of incidence of a ray with the angle `grazing` to a face's plane, from either side.
Radians to_normal(double grazing) {
    const double folded = grazing > pi ? 2 * pi - grazing : grazing;
    return {std::abs(pi / 2 - folded)};
}

}  // namespace

double knife_edge_loss_db(double nu) {
    // Behind the edge by f and g, because C - 1/2 and S - 1/2 oscillate and cancel for large nu.
    if (nu >= 0) return -10 * math::log10(std::norm(tail(nu)) / 2);
    const auto [c, s] = math::fresnel(nu);
    return -10 * math::log10(std::norm(Complex{0.5 - c, 0.5 - s}) / 2);
}

double knife_edge_loss_p526_db(double nu) {
    if (nu <= -0.78) return 0;
    const double v = nu - 0.1;
    return 6.9 + 20 * math::log10(std::sqrt(v * v + 1) + v);
}

Complex transition_function(double x) {
    const double t = std::sqrt(2 * x / pi);
    return pi * t * tail(t);
}

LitBy lit_by(const WedgePath& path) {
    const Deviations b = difference(path), c = sum(path);
    return {b.minus >= 0, c.minus >= 0 && !c.minus_turned, c.plus >= 0 && c.plus_turned};
}

FaceIncidence face_incidence(const WedgePath& path) {
    const auto [nearer, farther] = std::minmax(path.phi.value, path.phi_incident.value);
    return {to_normal(nearer), to_normal(path.n * pi - farther)};
}

Complex wedge_coefficient(const WedgePath& path, double k, Meters L, const WedgeFaces& faces,
                          LitBy lit) {
    const double kL = k * L.value, n = path.n;
    const Deviations b = difference(path), c = sum(path);
    const Complex direct =
        boundary_term(b.minus, lit.direct, n, kL) + boundary_term(b.plus, b.plus >= 0, n, kL);
    const Complex by_face_0 = boundary_term(c.minus, c.minus_turned || lit.face_0, n, kL);
    const Complex by_face_n = boundary_term(c.plus, !c.plus_turned || lit.face_n, n, kL);
    const Complex terms =
        (1.0 - faces.through) * direct + faces.face_0 * by_face_0 + faces.face_n * by_face_n;
    // -e^(-j pi/4) = (-1 + j) / sqrt 2.
    const double scale = 1 / (4 * n * std::sqrt(pi * k));
    return scale * (Complex{-1, 1} * terms);
}

}  // namespace rovernet
