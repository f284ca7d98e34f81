// SPDX-License-Identifier: MIT
#include "scene/materials/slab.hpp"

#include <numbers>

namespace rovernet {

using math::Complex;

Slab::Slab(ItuMaterial material, Hertz frequency)
    : wave_number_(2 * std::numbers::pi / speed_of_light * frequency.value) {
    const Permittivity p = permittivity(material, frequency);
    permittivity_ = {p.real, -p.imaginary};
}

SlabFields Slab::fields(double thickness, double cosine) const {
    // eta - sin^2 = eta - 1 + cos^2 is accurate at grazing incidence.
    const Complex a = math::square_root(permittivity_ - 1.0 + cosine * cosine);
    const Complex r = math::quotient(cosine - a, cosine + a);
    const double kd = wave_number_ * thickness;
    const double decay = kd * -a.imag();
    // Twice through the slab: exactly 0 in a thick slab.
    const Complex once = math::phasor(-kd * a.real());
    const double left = math::exp(-2 * decay);
    const Complex twice = left == 0 ? Complex{} : left * once * once;
    const Complex several = 1.0 - r * r * twice;
    return {math::quotient((1.0 - r * r) * once * math::phasor(kd * cosine), several), decay,
            math::quotient(r * (1.0 - twice), several)};
}

SlabPowers Slab::powers(double thickness, double cosine) const {
    const Complex a = math::square_root(permittivity_ - 1.0 + cosine * cosine);
    const Complex r = math::quotient(cosine - a, cosine + a);
    const double kd = wave_number_ * thickness, decay = kd * -a.imag();
    const double left = math::exp(-2 * decay);
    const Complex twice = left == 0 ? Complex{} : left * math::phasor(-2 * kd * a.real());
    const double several = std::norm(1.0 - r * r * twice);
    return {std::norm(1.0 - r * r) / several, decay, std::norm(r * (1.0 - twice)) / several};
}

double Slab::most_reflected(double cosine) const {
    const Complex a = math::square_root(permittivity_ - 1.0 + cosine * cosine);
    const double r2 = std::norm(cosine - a) / std::norm(cosine + a);
    return 4 * r2 / ((1 + r2) * (1 + r2));
}

}  // namespace rovernet
