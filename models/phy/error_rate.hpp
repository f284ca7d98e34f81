// SPDX-License-Identifier: MIT
#pragma once

#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>

// Error rates of IEEE 802.11b, a and g, used by the physical layer Wifi. A frame of n bits at a
// constant SINR is received with probability success(n log_success(modulation, sinr)).

namespace rovernet {

/// Modulation and coding of IEEE 802.11, named after its bit rate [Mb/s]: 802.11b with 22 MHz
/// bandwidth, and 802.11a and g with 20 MHz.
enum class Modulation : std::uint8_t {
    /// DBPSK, Barker sequence.
    dsss_1,
    /// DQPSK, Barker sequence.
    dsss_2,
    /// Complementary code keying, 4 bits a symbol.
    cck_5_5,
    /// Complementary code keying, 8 bits a symbol.
    cck_11,
    /// BPSK, rate 1/2.
    ofdm_6,
    /// BPSK, rate 3/4.
    ofdm_9,
    /// QPSK, rate 1/2.
    ofdm_12,
    /// QPSK, rate 3/4.
    ofdm_18,
    /// 16-QAM, rate 1/2.
    ofdm_24,
    /// 16-QAM, rate 3/4.
    ofdm_36,
    /// 64-QAM, rate 2/3.
    ofdm_48,
    /// 64-QAM, rate 3/4.
    ofdm_54,
};

/// Bit rates [bit/s] of all modulations, in the order of Modulation.
std::span<const BitRate> modulated_rates();
/// Modulation of a bit rate: 1, 2, 5.5, 11 Mb/s are DSSS and CCK; 6, 9, 12, 18, 24, 36, 48, 54 Mb/s
/// are OFDM; empty for other rates.
std::optional<Modulation> modulation_of(BitRate rate);

/// Bit error probability at the SINR S in white Gaussian noise, 0 ... 0.5; relative error of the
/// computation below 1e-10.
///
/// The result is limited to 0.5, the error probability of a guess: the equations of DSSS 2 and OFDM
/// exceed 0.5 at low S, where they are not valid. Bits are independent and have the same S: no
/// fading within a frame.
/// DSSS 1: e^(-22 S) / 2. J. G. Proakis, Digital Communications, 4th ed., eq. 5.2-69.
/// DSSS 2: (sqrt 2 + 1) / sqrt(8 pi sqrt 2 x) e^(-(2 - sqrt 2) x) with x = 11 S. G. Ferrari and
///   G. E. Corazza, Electronics Letters 40(20), 2004, eq. 8.
/// CCK: P = 1 - integral from -b to infinity of (1 - erfc((x + b) / sqrt 2))^7 phi(x) dx, phi the
///   normal density, is the error of a symbol of 4 bits (16 bi-orthogonal signals), b^2 = 16 S; a
///   bit is right with (1 - P)^(1/4). At 11 Mb/s two such sets share the power, which is 5.5 Mb/s
///   at half of S. M. B. Pursley and T. C. Royster, IEEE Trans. Comm. 57(2), 2009, eqs. 17 and 18.
///   16 S = Es / N0 is that of G. Pei and T. Henderson, Validation of ns-3 802.11b PHY model, 2009.
///   An ideal coherent receiver has b^2 = 2 Es / N0, so that it is 3 dB better.
/// OFDM: union bound on the Viterbi decoder of the code (133, 171) with hard decisions, up to ten
///   weights from the free distance on: sum of c_d D^d / (2 k), with D^2 = 4 p (1 - p), p the error
///   of an uncoded bit and k the bits that enter the code at a time. G. Pei and T. Henderson,
///   Validation of OFDM error rate model in ns-3, 2010 ("NIST"). Weights c_d: P. Frenger et al.,
///   IEEE Comm. Letters 3(11), 1999, for rate 1/2; D. Haccoun and G. Begin, IEEE Trans. Comm.
///   37(11), 1989, for 2/3 and 3/4.
///
/// @param  sinr  S, signal over interference and noise [-] in the receiver's bandwidth: 22 MHz for
///               DSSS and CCK, 20 MHz for OFDM; the result is 0.5 unless S > 0
double bit_error_rate(Modulation modulation, double sinr);

/// Natural logarithm of the probability that a bit is right, log(0.5) ... 0. Values can be summed
/// over bits and over chunks of different sinr; they are accurate even for error rates below 1e-16.
double log_success(Modulation modulation, double sinr);

/// Smallest signal to noise ratio [dB] at which success() is 1 for any number of bits up to 2^35.
Db certain_sinr(Modulation modulation);

/// Probability that all bits are right, from the sum of log_success() over these bits: e^sum.
double success(double log_success_sum);
}  // namespace rovernet
