// SPDX-License-Identifier: MIT
#include "models/variation/shadowing_field.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rovernet {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Magnitude of a wave vector, times d_cor [rad].
double wave_number(double u) {
    constexpr double longest = 50;
    static const double share = 1 - 1 / std::sqrt(1 + longest * longest);
    const double rest = 1 - u * share;
    return std::sqrt(1 / (rest * rest) - 1);
}

PairWaves::Wave shadow_wave(double decorrelation, const Key& key) {
    const auto draw = [&](std::uint64_t index) {
        Key each = key;
        each.index = index;
        return uniform(each);
    };
    const double k = wave_number(draw(0)) / (turn * decorrelation);
    const double q = wave_number(draw(2)) / (turn * decorrelation);
    const auto at_a = math::sincos(turn * draw(1)), at_b = math::sincos(turn * draw(3));
    return {k * at_a.cos, k * at_a.sin, q * at_b.cos, q * at_b.sin, draw(4)};
}

}  // namespace

ShadowingField::ShadowingField(Meters decorrelation_distance, std::uint64_t seed,
                               std::uint32_t replication)
    : decorrelation_(decorrelation_distance.value), waves_([&](std::size_t m) {
          return shadow_wave(decorrelation_, {.seed = seed,
                                              .replication = replication,
                                              .purpose = Purpose::field_shadowing,
                                              .a = m});
      }) {}

double ShadowingField::operator()(Vec3 a, Vec3 b) const {
    const double dx = a.x - b.x, dy = a.y - b.y;
    const double apart = std::sqrt(dx * dx + dy * dy);
    const double both = 2 * (1 + math::exp(-2 * apart / decorrelation_));
    constexpr double scale = 2.0 / PairWaves::count;
    const double z = std::sqrt(scale / both) * waves_.real(a, b);
    return std::clamp(z, -Shadowing::cut_sigmas, Shadowing::cut_sigmas);
}

}  // namespace rovernet
