// SPDX-License-Identifier: MIT
#include "models/propagation/edges/edge_pair.hpp"

#include "models/propagation/edges/diffraction.hpp"
#include "models/propagation/edges/fresnel.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rovernet {
namespace {

using math::Complex;
using std::numbers::pi;

/// Field past one screen, relative to free space: 1 far above its edge, 1/2 at it.
Complex past_screen(double nu) {
    const auto [c, s] = math::fresnel(nu);
    return Complex{0.5, 0.5} * Complex{0.5 - c, s - 0.5};
}

/// Function V for edges that both obstruct the path, nu >= 0, without the phase of the path by
/// both. Midpoint rule in the angle whose cosine is uniform over the sector: it converges as fast
/// as Gauss quadrature.
Complex sector(double angle, double sine, double nu_first, double nu_last) {
    constexpr int parts = 20;
    Complex sum = 0;
    for (int i = 0; i < parts; ++i) {
        const auto [weight, cosine] = math::sincos((i + 0.5) * pi / parts);
        const double p = angle * (1 - cosine) / 2;
        const double s =
            (nu_first * math::sincos(angle - p).sin + nu_last * math::sincos(p).sin) / sine;
        sum += weight * (1.0 - transition_function(pi / 2 * s * s));
    }
    return angle / (4 * parts) * sum;
}

/// Weight of the face's mirrored part: 1 at an obstructing edge, 0 far above a lit edge.
double nearness(double nu) { return nu >= 0 ? 1 : std::max(0.0, 1 - nu * nu / 9); }

double nu_of(double bend, double wavelength) {
    return std::copysign(2 * std::sqrt(std::abs(bend) / wavelength), bend);
}

}  // namespace

double mirrored_share(const EdgePair& pair, double wavelength) {
    return nearness(nu_of(pair.first, wavelength)) * nearness(nu_of(pair.last, wavelength));
}

Complex screen_field(double bend, double wavelength) {
    const double nu = nu_of(bend, wavelength);
    return nu > 0 ? math::phasor(pi / 2 * nu * nu) * past_screen(nu) : past_screen(nu);
}

Complex pair_field(const EdgePair& pair, double wavelength) {
    const double first = nu_of(pair.first, wavelength), last = nu_of(pair.last, wavelength);
    const double both = (pair.before + pair.along) * (pair.along + pair.after);
    const double rho = std::sqrt(pair.before * pair.after / both);
    const double sine =
        std::sqrt(pair.along * (pair.before + pair.along + pair.after) / both);  // cos(asin rho)
    const double wide = pi / 2 + math::atan2(rho, sine), narrow = pi - wide;
    const auto V = [&](double angle) {
        return sector(angle, sine, std::abs(first), std::abs(last));
    };
    const double face = pair.face ? 1 : 0;
    const bool shadowed = first >= 0 && last >= 0, lit = first < 0 && last < 0;
    const Complex V_wide = pair.face || shadowed || lit ? V(wide) : 0;
    const Complex V_narrow = pair.face || !(shadowed || lit) ? V(narrow) : 0;
    if (shadowed) return V_wide - V_narrow;

    // Each edge relative to the straight line, without and with the mirror image; then phases
    // relative to the straight line: of the path by both edges, and of the line from the mirrored
    // end.
    const double nu_1 = (first + rho * last) / sine, nu_2 = (last + rho * first) / sine;
    const double mirrored_1 = (first - rho * last) / sine, mirrored_2 = (last - rho * first) / sine;
    const Complex by_both = math::phasor(-pi / 2 * (first * nu_1 + last * nu_2) / sine);
    const Complex by_mirror = math::phasor(-2 * pi * rho * first * last / (sine * sine));
    const double near_1 = nearness(first), near_2 = nearness(last);
    if (lit) {
        const Complex screens =
            1.0 - near_1 * (1.0 - past_screen(nu_1)) - near_2 * (1.0 - past_screen(nu_2));
        const Complex mirrored = face * (past_screen(mirrored_1) + past_screen(mirrored_2) - 1.0);
        return screens + near_1 * near_2 * (by_both * (V_wide - V_narrow) - by_mirror * mirrored);
    }
    const double nu = first < 0 ? nu_2 : nu_1, mirrored = first < 0 ? mirrored_2 : mirrored_1;
    const Complex less = by_both * (V_narrow - V_wide) + face * by_mirror * past_screen(mirrored);
    const Complex by_edge = math::phasor(nu > 0 ? pi / 2 * nu * nu : 0);
    return by_edge * (past_screen(nu) - near_1 * near_2 * less);
}

}  // namespace rovernet
