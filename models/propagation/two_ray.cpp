// SPDX-License-Identifier: MIT
#include "models/propagation/two_ray.hpp"

#include "models/propagation/friis.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rovernet {
namespace {

/// Wave number 2 pi / lambda [rad/m].
double wave_number(Hertz f) { return 2 * std::numbers::pi / speed_of_light * f.value; }

}  // namespace

Meters TwoRay::reach(Db loss, Hertz f, Meters highest) const {
    const double h = height(highest.value);
    if (form == TwoRayForm::ns2) {
        return {std::min(Friis{}.reach(loss, f).value, h * math::exp10(loss.value / 40))};
    }
    constexpr Db in_phase{6.0206};  // 20 log10 2, rounded up
    const double k = wave_number(f), e = ground_permittivity;
    const double of_ground = (polarization == Polarization::vertical ? e : 1) / std::sqrt(e - 1);
    const double A = 2 * h * h + 2 * k * h * h + 4 * h * of_ground;
    const double by_height = std::max(1.0, std::sqrt(math::exp10(loss.value / 20) * A / (2 * k)));
    return {std::min(Friis{}.reach(loss + in_phase, f).value, by_height)};
}

void TwoRay::loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
    if (form == TwoRayForm::exact) return exact_loss(links, out_db);
    const Hertz f = links.frequency;
    const double ht = height(links.from.z);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double d = links.distance(i);
        const double crossover =
            4 * std::numbers::pi / speed_of_light * f.value * (ht * height(links.to[i].z));
        out_db[i] = std::max(0.0, free_space_db(d * std::max(1.0, d / crossover), f));
    }
}

/// Amplitude |1 + r exp(-j phi)| with r = G d1 / d2, computed as its square (1 + r)^2 - 4 r
/// sin^2(phi/2), with 1 + r from d2 - d1 and 1 + G, so that no nearly equal numbers are subtracted
/// at large distances.
void TwoRay::exact_loss(const LinkBatch& links, std::span<double> out_db) const {
    const double k = wave_number(links.frequency);
    const double ht = height(links.from.z);
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double hr = height(links.to[i].z);
        const Vec3 apart = links.to[i] - links.from;
        const double ground2 = apart.x * apart.x + apart.y * apart.y;
        const double d1 = std::sqrt(ground2 + (ht - hr) * (ht - hr));
        const double d2 = std::sqrt(ground2 + (ht + hr) * (ht + hr));
        const double longer = 4 * ht * hr / (d1 + d2);
        const double sine = (ht + hr) / d2;
        const double z = std::sqrt(ground_permittivity - 1 + sine * sine);  // cos^2 = 1 - sin^2
        const double up =
            polarization == Polarization::vertical ? ground_permittivity * sine : sine;
        const double G = (up - z) / (up + z);
        const double one_and_G = 2 * up / (up + z);
        const double r = G * (d1 / d2);
        const double one_and_r = (longer + one_and_G * d1) / d2;
        const double half_sine = math::sincos(k * longer / 2).sin;
        const double power = one_and_r * one_and_r - 4 * r * (half_sine * half_sine);
        const double loss = free_space_db(d1, links.frequency) - 10 * math::log10(power);
        out_db[i] = std::max(0.0, loss);
    }
}

}  // namespace rovernet
