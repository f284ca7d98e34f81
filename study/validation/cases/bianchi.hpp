// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/csma.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>

namespace rovernet {

/// Saturation throughput of the 802.11 DCF by Bianchi's model, for `n` stations in range of each
/// other that always have a frame to send. Throughput is the share of time in which payload bits
/// are received.
///
/// Source: G. Bianchi, Performance analysis of the IEEE 802.11 distributed coordination function,
/// IEEE JSAC 18(3), 2000; equations 7, 9-13.
struct Bianchi {
    int window = 32;                           ///< initial contention window W = CWmin + 1 [slots]
    int stages = 3;                            ///< number m of doublings of the contention window
    double slot, payload, success, collision;  ///< durations [us]: slot, mean payload E[P], success
                                               ///< Ts, collision Tc

    /// Probability that a station transmits in a slot, if its frames collide with the probability
    /// `p`.
    double attempts(double p) const {
        const double q = 1 - 2 * p;
        return 2 * q / (q * (window + 1) + p * window * (1 - std::pow(2 * p, stages)));
    }
    double attempt_probability(int n) const {
        double low = 0, high = 1;
        for (int i = 0; i < 200; ++i) {
            const double tau = (low + high) / 2;
            const double p = 1 - std::pow(1 - tau, n - 1);
            (attempts(p) > tau ? low : high) = tau;
        }
        return low;
    }
    double throughput(int n) const { return throughput(n, attempt_probability(n)); }
    double throughput(int n, double tau) const {
        const double some = 1 - std::pow(1 - tau, n);
        const double one = n * tau * std::pow(1 - tau, n - 1);
        return one * payload / ((1 - some) * slot + one * success + (some - one) * collision);
    }
};

/// Group of stations in range of each other, with the parameters of Bianchi's table II: 1 Mb/s;
/// slot 50, SIFS 28, DIFS 128 us; 8184 bits of payload after 272 bits of MAC header and a preamble
/// of 128 us. No EIFS, no retry limit, no sensing delay.
struct BianchiCell {
    static constexpr std::uint32_t payload = 1023;  ///< payload of a frame [bytes]
    static constexpr BitRate rate{1e6};
    static constexpr Duration preamble = std::chrono::microseconds{128};

    int window = 32;    ///< initial contention window W = CWmin + 1 [slots]
    int stages = 3;     ///< number m of doublings of the contention window
    bool asks = false;  ///< true: RTS and CTS precede each data frame

    Bianchi theory() const {
        constexpr double sifs = 28, difs = 128, bits = 8 * payload;
        constexpr double data = 128 + 272 + bits, ack = 128 + 112, rts = 128 + 160, cts = ack;
        const double before = asks ? rts + sifs + cts + sifs : 0;
        return {.window = window,
                .stages = stages,
                .slot = 50,
                .payload = bits,
                .success = before + data + sifs + ack + difs,
                .collision = (asks ? rts : data) + difs};
    }
    Csma csma() const {
        using namespace std::chrono_literals;
        return {.slot = 50us,
                .sifs = 28us,
                .difs = 128us,
                .cca_time = 0us,
                .turnaround = 0us,
                .rx_start_delay = 0us,
                .cw_min = window - 1,
                .cw_max = (window << stages) - 1,
                .basic_rates = {{rate}},
                .eifs = EifsRule::none,
                .short_retries = 0,
                .long_retries = 0,
                .rts_threshold = asks ? 0U : 100'000U,
                .header = 34};
    }
};

}  // namespace rovernet
