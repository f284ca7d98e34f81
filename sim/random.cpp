// SPDX-License-Identifier: MIT
#include "sim/random.hpp"

#include "sim/math.hpp"

#include <xxhash.h>

#include <cassert>
#include <cmath>

namespace rovernet {
namespace {

__extension__ using Uint128 = unsigned __int128;

// Key of a seed, a replication and a purpose.
std::uint64_t stream(std::uint64_t seed, std::uint32_t replication, Purpose purpose) {
    return combine(seed, std::uint64_t{replication} << 16 | static_cast<std::uint16_t>(purpose));
}

// The midpoint of the cell of 2^-52 that the upper bits number.
double midpoint(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

constexpr std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
constexpr std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

using Coefficients = std::array<double, 8>;

double polynomial(const Coefficients& c, double x) {
    double sum = c[7];
    for (int i = 6; i >= 0; --i) sum = sum * x + c[static_cast<std::size_t>(i)];
    return sum;
}

// AS 241, PPND16: numerators and denominators, |p - 1/2| <= 0.425; r <= 5; r > 5.
constexpr Coefficients centre_num = {3.3871328727963666080e0, 1.3314166789178437745e2,
                                     1.9715909503065514427e3, 1.3731693765509461125e4,
                                     4.5921953931549871457e4, 6.7265770927008700853e4,
                                     3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr Coefficients centre_den = {1,
                                     4.2313330701600911252e1,
                                     6.8718700749205790830e2,
                                     5.3941960214247511077e3,
                                     2.1213794301586595867e4,
                                     3.9307895800092710610e4,
                                     2.8729085735721942674e4,
                                     5.2264952788528545610e3};
constexpr Coefficients tail_num = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                   5.76949722146069140550e0,  3.64784832476320460504e0,
                                   1.27045825245236838258e0,  2.41780725177450611770e-1,
                                   2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Coefficients tail_den = {1,
                                   2.05319162663775882187e0,
                                   1.67638483018380384940e0,
                                   6.89767334985100004550e-1,
                                   1.48103976427480074590e-1,
                                   1.51986665636164571966e-2,
                                   5.47593808499534494600e-4,
                                   1.05075007164441684324e-9};
constexpr Coefficients far_num = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                  1.78482653991729133580e0,  2.96560571828504891230e-1,
                                  2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                  2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Coefficients far_den = {1,
                                  5.99832206555887937690e-1,
                                  1.36929880922735805310e-1,
                                  1.48753612908506148525e-2,
                                  7.86869131145613259100e-4,
                                  1.84631831751005468180e-5,
                                  1.42151175831644588870e-7,
                                  2.04426310338993978564e-15};

// Distance of the p-quantile from 0, for the smaller tail p < 0.075.
double tail_quantile(double p) {
    const double r = std::sqrt(-math::log(p));
    return r <= 5 ? polynomial(tail_num, r - 1.6) / polynomial(tail_den, r - 1.6)
                  : polynomial(far_num, r - 5) / polynomial(far_den, r - 5);
}

}  // namespace

std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t p0 = std::uint64_t{0xd2511f53} * counter[0];
        const std::uint64_t p1 = std::uint64_t{0xcd9e8d57} * counter[2];
        counter = {high(p1) ^ counter[1] ^ key[0], low(p1), high(p0) ^ counter[3] ^ key[1],
                   low(p0)};
        key[0] += 0x9e3779b9;  // golden ratio
        key[1] += 0xbb67ae85;  // sqrt(3) - 1
    }
    return counter;
}

std::uint64_t bits(const Key& key) {
    const std::uint64_t cipher = mix(stream(key.seed, key.replication, key.purpose) + key.index);
    const auto words = philox4x32_10({low(key.a), high(key.a), low(key.b), high(key.b)},
                                     {low(cipher), high(cipher)});
    return std::uint64_t{words[1]} << 32 | words[0];
}

double uniform(const Key& key) { return midpoint(bits(key)); }

double normal(const Key& key) { return normal_quantile(uniform(key)); }

double exponential(const Key& key) { return -math::log(uniform(key)); }

std::uint64_t below(const Key& key, std::uint64_t n) {
    assert(n > 0);
    return static_cast<std::uint64_t>(Uint128{bits(key)} * n >> 64);
}

PairDraws::PairDraws(std::uint64_t seed, std::uint32_t replication, Purpose purpose)
    : stream_(stream(seed, replication, purpose)) {}

double PairDraws::uniform(std::uint64_t a, std::uint64_t b) const { return midpoint(bits(a, b)); }

double PairDraws::normal_of(std::uint64_t bits) { return normal_quantile(midpoint(bits)); }

double normal_quantile(double p) {
    const double q = p - 0.5;
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(centre_num, r) / polynomial(centre_den, r);
    }
    return q < 0 ? -tail_quantile(p) : tail_quantile(1 - p);
}

std::uint64_t name_key(std::string_view name) { return XXH64(name.data(), name.size(), 0); }

}  // namespace rovernet
