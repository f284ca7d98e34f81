// SPDX-License-Identifier: MIT
#include "models/propagation/edges/fresnel.hpp"

#include "sim/math.hpp"
#include "sim/polynomial.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace rovernet::math {
namespace {

constexpr double near_end = 2.5;

// Coefficients of f and g in 2 t / near_end - 1, for t from 0 to near_end: Chebyshev interpolation,
// error 1e-17.
constexpr std::array<double, 27> near_f{
    0x1.e526f6fb621c4p-3,   -0x1.83aaf85944ca8p-3,  0x1.e89d3065e9b69p-4,   -0x1.8d98202586c8cp-5,
    -0x1.70456466daaeap-9,  0x1.bdaaff70a81ap-6,    -0x1.e83aa4349f75p-6,   0x1.5ddd98a5fccc2p-6,
    -0x1.6c99f5f787f5fp-7,  0x1.f4ab090044d23p-9,   -0x1.98036dd5424fap-13, -0x1.d1e7f88c28ecep-11,
    0x1.a64aca4f4d12ep-11,  -0x1.d11479cb714cap-12, 0x1.5ce5e91308311p-13,  -0x1.06677677ab8fdp-15,
    -0x1.7419cdce97f1cp-17, 0x1.df440c5af3984p-17,  -0x1.0c37756dc6ddep-17, 0x1.7fdc4e658ca68p-19,
    -0x1.35cec9981a1cep-21, -0x1.5e187c1772228p-26, 0x1.17b025c3e7c1cp-23,  -0x1.03d034d5e3843p-23,
    0x1.66f725bbb716ep-25,  0x1.96d8e5e520a88p-28,  -0x1.4fbf462d2a0c2p-28};
constexpr std::array<double, 27> near_g{
    0x1.3be67289b2796p-5,   -0x1.650783bf6ed2fp-4,  0x1.de8673cbd5552p-4,   -0x1.d525b2c08cf6bp-4,
    0x1.63a8aa0b1834bp-4,   -0x1.9cef1eb49f19ap-5,  0x1.46f32a57cc7e6p-6,   -0x1.dd88d5f39b8acp-10,
    -0x1.539852bf8d6b2p-8,  0x1.6d91e61657b77p-8,   -0x1.d620dd9665294p-9,  0x1.a815f295abd2ap-10,
    -0x1.d09df6aabfadfp-12, -0x1.077c99dcec7f2p-15, 0x1.0a1b81c60dcbdp-13,  -0x1.7c724aad3dd9fp-14,
    0x1.5bd7d04a9ee57p-15,  -0x1.9a581f30f7dbbp-17, 0x1.bf8fa21d386ecp-21,  0x1.b256b0e4522a4p-20,
    -0x1.46525d57b5a71p-20, 0x1.21da2a5846421p-21,  -0x1.6bee24201c2c8p-23, 0x1.54142333a5cb7p-26,
    0x1.6c81f8648eae5p-26,  -0x1.eb88e07678344p-27, 0x1.9180700e2f7c5p-29};

// Coefficients of pi t f and pi^2 t^3 g in 2 (near_end / t)^4 - 1 for t > near_end; error 2e-16 of
// the result.
constexpr std::array<double, 25> far_f{
    0x1.fe16c22c334e1p-1,  -0x1.d6874a3ceb884p-9,  0x1.104b490c66e8cp-13,  -0x1.7216a0e6d3a3bp-17,
    0x1.97a4057cff0bdp-20, -0x1.3335f8400f782p-22, 0x1.20ad73eb83aa4p-24,  -0x1.3f922d588ede5p-26,
    0x1.91933b05d1f18p-28, -0x1.170998ac7f489p-29, 0x1.a4f26ecff2dfap-31,  -0x1.588fe868a5d75p-32,
    0x1.2d410a293d92cp-33, -0x1.b637b9d66837dp-35, 0x1.2c481de847c28p-36,  -0x1.2c66dda59290dp-35,
    0x1.e5560e84991bdp-36, 0x1.9b638f767833ep-36,  -0x1.9cee80b95896p-36,  -0x1.a79e9a9f2e1dep-36,
    0x1.6f57c93fb4222p-36, 0x1.89a3876134c4cp-37,  -0x1.49be47ce7575dp-37, -0x1.8d82d72fc0cb2p-39,
    0x1.33678d69e432cp-39};
constexpr std::array<double, 25> far_g{
    0x1.f6bca5033f9ffp-1,  -0x1.150fd9d54cc37p-6,  0x1.0fa29318527bp-10,   -0x1.f37bc4190337ap-14,
    0x1.511d682014567p-16, -0x1.26f5c85065e51p-18, 0x1.373f3a2c83e8bp-20,  -0x1.7a70f93ceec31p-22,
    0x1.011d4a8252a14p-23, -0x1.7dd1369da5771p-25, 0x1.30ef317407b96p-26,  -0x1.08eb4266b3001p-27,
    0x1.eab5e1c2784bcp-29, -0x1.430f9c06b72f2p-30, 0x1.50a3321e3351fp-32,  -0x1.549efe511b6f8p-30,
    0x1.28bac75f56555p-30, 0x1.14ffeb68f477bp-30,  -0x1.16aba025b33abp-30, -0x1.0e14e808bf8d7p-30,
    0x1.e0473d01d4965p-31, 0x1.fae38598eb4c1p-32,  -0x1.b1303322fe394p-32, -0x1.f4bf5ba9d1a2bp-34,
    0x1.8c6e5f9f8fe08p-34};

// Remainder of x modulo 4, exact.
double modulo_4(double x) { return x - 4 * std::floor(x / 4); }

// Remainder of x^2 modulo 4 for x >= 0: the halves of x have at most 27 bits, so their products are
// exact except for the last bit of lo * lo.
double square_modulo_4(double x) {
    const auto upper_bits = ~std::uint64_t{0x7ffffff};
    const double hi = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & upper_bits);
    const double lo = x - hi;
    return modulo_4(modulo_4(hi * hi) + modulo_4(2 * hi * lo) + modulo_4(lo * lo));
}

}  // namespace

FresnelTail fresnel_tail(double t) {
    using std::numbers::pi;
    if (t < near_end) {
        const double u = 2 * t / near_end - 1;
        return {polynomial(near_f, u), polynomial(near_g, u)};
    }
    const double nearness = near_end / t;
    const double square = nearness * nearness;
    const double u = 2 * (square * square) - 1;
    return {polynomial(far_f, u) / (pi * t), polynomial(far_g, u) / (pi * t) / (pi * t) / t};
}

Fresnel fresnel(double x) {
    constexpr double limit = 1e16;  // f is below the last bit of 1/2
    const double t = std::abs(x);
    if (t >= limit) return {std::copysign(0.5, x), std::copysign(0.5, x)};
    const auto [f, g] = fresnel_tail(t);
    const auto [sine, cosine] = sincos(std::numbers::pi / 2 * square_modulo_4(t));
    return {std::copysign(0.5 + f * sine - g * cosine, x),
            std::copysign(0.5 - f * cosine - g * sine, x)};
}

}  // namespace rovernet::math
