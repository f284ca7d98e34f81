// SPDX-License-Identifier: MIT
#include "scene/materials/p2040.hpp"

#include "sim/complex_math.hpp"
#include "sim/math.hpp"

#include <complex>

namespace rovernet {
namespace {

using math::Complex;

/// eps_r = a f^b, sigma = c f^d [S/m], f in GHz.
struct Law {
    double a, b, c, d;
};

/// ITU-R P.2040-3, table 3, in the order of ItuMaterial; floorboard is tabulated for 50-100 GHz.
constexpr std::array<Law, EnumNames<ItuMaterial>::values.size()> laws = {{
    {5.24, 0, 0.0462, 0.7822},   // concrete
    {3.91, 0, 0.0238, 0.16},     // brick
    {2.73, 0, 0.0085, 0.9395},   // plasterboard
    {1.99, 0, 0.0047, 1.0718},   // wood
    {6.31, 0, 0.0036, 1.3394},   // glass
    {1.48, 0, 0.0011, 1.0750},   // ceiling board
    {2.58, 0, 0.0217, 0.78},     // chipboard
    {2.71, 0, 0.33, 0},          // plywood
    {7.074, 0, 0.0055, 0.9262},  // marble
    {3.66, 0, 0.0044, 1.3515},   // floorboard
    {1, 0, 1e7, 0},              // metal
}};

double power(double base, double exponent) { return math::exp2(exponent * math::log2(base)); }

double decibels(Complex z) { return 10 * math::log10(std::norm(z)); }

}  // namespace

Permittivity permittivity(ItuMaterial material, Hertz frequency) {
    // 1 / (2 pi eps_0) in GHz m / S, with eps_0 = 8.8541878128e-12 F/m (CODATA 2018).
    constexpr double per_farad = 17.975103584522344;
    const Law& law = laws[static_cast<std::size_t>(material)];
    const double f = frequency.value / 1e9;
    return {law.a * power(f, law.b), per_farad * law.c * power(f, law.d) / f};
}

namespace {

/// Losses of a slab for one polarisation.
struct Losses {
    Db transmission, reflection;
};
/// @param x  cosine of the angle (TE), or that times the complex permittivity eta (TM)
/// @param a  square root of eta - sin^2 of the angle: its face reflects r = (x - a) / (x + a)
/// @param k  wave number in air times the thickness
Losses losses(Complex x, Complex a, double k) {
    constexpr double db_per_neper = 8.685889638065037;
    const Complex r = math::quotient(x - a, x + a);
    // 1 - r^2 in product form, because as a difference it loses its digits at grazing angles (r
    // near -1).
    const Complex both_faces = math::quotient(4.0 * x * a, (x + a) * (x + a));
    const Complex twice = math::exp(Complex{0, -2 * k} * a);  // over to the other face and back
    // |T| = |1 - r^2| |e^-jq| / |1 - r^2 e^-2jq|; the middle factor in decibels, where a thick
    // sheet of metal cannot underflow. |R| = |r| |1 - e^-2jq| / |1 - r^2 e^-2jq|.
    const double several = decibels(both_faces + r * r * (1.0 - twice));
    return {Db{db_per_neper * k * -a.imag() - decibels(both_faces) + several},
            Db{several - decibels(r) - decibels(1.0 - twice)}};
}

}  // namespace

SlabLosses slab_losses(ItuMaterial material, Meters thickness, Hertz frequency, Radians incidence) {
    constexpr double two_pi_over_c = 6.283185307179586 / 299'792'458;
    const Permittivity p = permittivity(material, frequency);
    const auto [sine, cosine] = math::sincos(incidence.value);
    const Complex eta{p.real, -p.imaginary};
    const Complex a = math::square_root({p.real - sine * sine, -p.imaginary});
    const double k = two_pi_over_c * frequency.value * thickness.value;
    const Losses te = losses(cosine, a, k);
    const Losses tm = losses(eta * cosine, a, k);
    return {te.transmission, tm.transmission, te.reflection, tm.reflection};
}

Db slab_loss(ItuMaterial material, Meters thickness, Hertz frequency) {
    return slab_losses(material, thickness, frequency, Radians{0}).te_transmission;
}

}  // namespace rovernet
