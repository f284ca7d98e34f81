// SPDX-License-Identifier: MIT
#include "models/phy/error_rate.hpp"

#include "sim/math.hpp"
#include "sim/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

constexpr double guess = 0.5;  // what knows nothing of a bit is wrong about it half the time

constexpr std::array<BitRate, 12> all_rates{
    {{1e6}, {2e6}, {5.5e6}, {11e6}, {6e6}, {9e6}, {12e6}, {18e6}, {24e6}, {36e6}, {48e6}, {54e6}}};

double dbpsk(double S) { return 0.5 * math::exp(-22 * S); }

double dqpsk(double S) {
    const double x = 11 * S;
    constexpr double scale = 0.40494706590575065;  // (sqrt 2 + 1) / sqrt(8 pi sqrt 2)
    constexpr double two_minus_root = 0.58578643762690495;
    return scale / std::sqrt(x) * math::exp(-two_minus_root * x);
}

// Approximation of P / erfc(b / 2) in three pieces of b, -1 ... 1 from end to end; Chebyshev,
// relative error 4e-12. It tends to 7, for 14 neighbours that each win with erfc(b / 2) / 2, and
// equals it to 2e-15 at b = 21.
constexpr double piece_1 = 6, piece_2 = 12, piece_3 = 21;
constexpr std::array<double, 21> error_over_erfc_0_to_6{
    0x1.ec7a8cb4a3448p+1,  0x1.0437aa313238dp+2,  -0x1.a75dce157421dp-4,  -0x1.bdef9ea12e268p+0,
    0x1.23a83ad9ce4aap-4,  0x1.6c50d04f24acap-1,  -0x1.6d797bc3b07c7p-5,  -0x1.ec57a30011195p-3,
    0x1.7f1148f718615p-6,  0x1.1535bebd20ebcp-4,  -0x1.392c111208f7cp-7,  -0x1.07dc1d7d9f4c2p-6,
    0x1.951cf476a30e0p-9,  0x1.adc26bb022b9dp-9,  -0x1.acc88fa4590fcp-11, -0x1.29d4bc0b833bcp-11,
    0x1.75ffa1dfa9011p-13, 0x1.47d880b1b5706p-14, -0x1.f31ffddb88d43p-16, -0x1.b103517e3426dp-18,
    0x1.7c106ec933b7bp-19};
constexpr std::array<double, 17> error_over_erfc_6_to_12{
    0x1.bf89284e14653p+2,   0x1.1902777fcc52fp-5,  -0x1.3523fe7f69a7ep-4, 0x1.9d9bd5ad96fc2p-4,
    -0x1.6d5ed71ca243bp-4,  0x1.a4a47926c7704p-5,  -0x1.f877ecbbdd673p-7, -0x1.5603b3f372990p-9,
    0x1.61cb9c9bf0f08p-8,   -0x1.57349177261d8p-9, 0x1.5c70636cce70ep-12, 0x1.5fc60542b0cd5p-12,
    -0x1.d36716bf4459ep-13, 0x1.465ada858b3d6p-15, 0x1.3d55dc292b61bp-16, -0x1.4327f7759c285p-17,
    0x1.b770d2be2c63ap-21};
constexpr std::array<double, 15> error_over_erfc_12_to_21{
    0x1.bfffffff739b4p+2,   0x1.cf4d3a93219c2p-28, -0x1.571e6f59fc75cp-25, 0x1.4296ee64ef998p-23,
    -0x1.fddbda089dfdfp-22, 0x1.45a977dae83dbp-20, -0x1.13b439ad3187cp-19, 0x1.5da8a35bf1a1ep-19,
    -0x1.145316ebfc69ep-18, 0x1.9a022474fab67p-18, -0x1.3b7c11402b733p-18, 0x1.fd5879eabcac7p-20,
    -0x1.517f2800afcfdp-19, 0x1.9cc057db151f4p-19, -0x1.3609634f8fde2p-20};

double error_over_erfc(double b) {
    if (b < piece_1) return math::polynomial(error_over_erfc_0_to_6, (b - 3) / 3);
    if (b < piece_2) return math::polynomial(error_over_erfc_6_to_12, (b - 9) / 3);
    if (b < piece_3) return math::polynomial(error_over_erfc_12_to_21, (b - 16.5) / 4.5);
    return 7;
}

// Symbol error probability of 16 bi-orthogonal signals with b^2 = Es / N0.
double symbol_error(double b) { return error_over_erfc(b) * math::erfc(b / 2); }

// Logarithm of the probability that one of the 4 bits of a symbol is right.
double log_bit_success(double b) { return math::log1p(-symbol_error(b)) / 4; }

double cck_log_success(Modulation modulation, double S) {
    return log_bit_success(std::sqrt((modulation == Modulation::cck_11 ? 8 : 16) * S));
}

// Bit error probability of an uncoded constellation: share / 2 erfc(sqrt(S / spread)).
struct Constellation {
    double spread;
    double share;
};
constexpr Constellation bpsk{1, 1};
constexpr Constellation qpsk{2, 1};
constexpr Constellation qam_16{10, 3.0 / 4};
constexpr Constellation qam_64{42, 7.0 / 12};

double uncoded(const Constellation& c, double S) {
    return 0.5 * c.share * math::erfc(std::sqrt(S / c.spread));
}

// Numbers of wrong bits on all wrong paths of weight d, d + step, d + 2 step ..., divided by 2 k,
// where k bits enter the code at a time. The last 0 in two of the lists makes their length odd.
constexpr std::array<double, 9> weights_1_2{36 / 2.0,      211 / 2.0,      1404 / 2.0,
                                            11633 / 2.0,   77433 / 2.0,    502690 / 2.0,
                                            3322763 / 2.0, 21292910 / 2.0, 134365911 / 2.0};
constexpr std::array<double, 11> weights_2_3{
    3 / 4.0,      70 / 4.0,     285 / 4.0,     1276 / 4.0,    6160 / 4.0, 27128 / 4.0,
    117019 / 4.0, 498860 / 4.0, 2103891 / 4.0, 8784123 / 4.0, 0};
constexpr std::array<double, 11> weights_3_4{42 / 6.0,
                                             201 / 6.0,
                                             1492 / 6.0,
                                             10469 / 6.0,
                                             62935 / 6.0,
                                             379644 / 6.0,
                                             2253373 / 6.0,
                                             13073811 / 6.0,
                                             75152755 / 6.0,
                                             428005675 / 6.0,
                                             0};

// Squared D for the uncoded bit error probability p.
double squared_bhattacharyya(double p) { return 4 * p * (1 - p); }

double rate_1_2(double p) {
    const double D2 = squared_bhattacharyya(p);
    const double D4 = D2 * D2;
    return D4 * D4 * D2 * math::polynomial(weights_1_2, D2);
}

double rate_2_3(double p) {
    const double D2 = squared_bhattacharyya(p);
    return D2 * D2 * D2 * math::polynomial(weights_2_3, std::sqrt(D2));
}

double rate_3_4(double p) {
    const double D2 = squared_bhattacharyya(p);
    const double D = std::sqrt(D2);
    return D2 * D2 * D * math::polynomial(weights_3_4, D);
}

// Bit error rate by the equations; may be above 1.
double unclamped(Modulation modulation, double S) {
    switch (modulation) {
        case Modulation::dsss_1: return dbpsk(S);
        case Modulation::dsss_2: return dqpsk(S);
        case Modulation::cck_5_5:
        case Modulation::cck_11: return -math::expm1(cck_log_success(modulation, S));
        case Modulation::ofdm_6: return rate_1_2(uncoded(bpsk, S));
        case Modulation::ofdm_9: return rate_3_4(uncoded(bpsk, S));
        case Modulation::ofdm_12: return rate_1_2(uncoded(qpsk, S));
        case Modulation::ofdm_18: return rate_3_4(uncoded(qpsk, S));
        case Modulation::ofdm_24: return rate_1_2(uncoded(qam_16, S));
        case Modulation::ofdm_36: return rate_3_4(uncoded(qam_16, S));
        case Modulation::ofdm_48: return rate_2_3(uncoded(qam_64, S));
        case Modulation::ofdm_54: return rate_3_4(uncoded(qam_64, S));
    }
    return guess;
}

}  // namespace

std::span<const BitRate> modulated_rates() { return all_rates; }

std::optional<Modulation> modulation_of(BitRate rate) {
    const auto found = std::find(all_rates.begin(), all_rates.end(), rate);
    if (found == all_rates.end()) return std::nullopt;
    return static_cast<Modulation>(found - all_rates.begin());
}

double bit_error_rate(Modulation modulation, double sinr) {
    if (!(sinr > 0)) return guess;
    return std::min(unclamped(modulation, sinr), guess);
}

double log_success(Modulation modulation, double sinr) {
    const bool cck = modulation == Modulation::cck_5_5 || modulation == Modulation::cck_11;
    if (cck && sinr > 0) return cck_log_success(modulation, sinr);
    return math::log1p(-bit_error_rate(modulation, sinr));
}

Db certain_sinr(Modulation modulation) {
    constexpr double most_bits = 8 * 0x1p32;
    // A value that is below 1 by this rounds to 1.
    constexpr double nothing = -0x1p-55;
    static const auto certain = [] {
        std::array<Db, all_rates.size()> out;
        for (std::size_t i = 0; i < out.size(); ++i) {
            double fails = -50, succeeds = 50;  // [dB]
            while (succeeds - fails > 1e-3) {
                const double middle = (fails + succeeds) / 2;
                const double sinr = math::exp10(middle / 10);
                const double sum = most_bits * log_success(static_cast<Modulation>(i), sinr);
                (sum >= nothing ? succeeds : fails) = middle;
            }
            out[i] = Db{succeeds};
        }
        return out;
    }();
    return certain[static_cast<std::size_t>(modulation)];
}

double success(double log_success_sum) { return math::exp(log_success_sum); }

}  // namespace rovernet
