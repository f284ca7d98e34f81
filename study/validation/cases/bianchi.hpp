// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/dcf.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>

namespace rovernet {

/// Saturation throughput of the 802.11 DCF, for `n` stations that hear one another and always have
/// a frame to send: the share of the time in which payload bits get through.
///
/// Source: G. Bianchi, Performance analysis of the IEEE 802.11 distributed coordination function,
/// IEEE JSAC 18(3), 2000; equations 7, 9-13.
struct Bianchi {
    int window = 32;                           ///< W = CWmin + 1 [slots]
    int stages = 3;                            ///< m: the window doubles so often
    double slot, payload, success, collision;  ///< [us]; of a slot, E[P], Ts, Tc

    /// Probability that a station sends in a slot, where the others collide with it with `p`.
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

/// A cell of Bianchi's, table II: 1 Mb/s; slot 50, SIFS 28, DIFS 128 us; 8184 bits of payload
/// behind 272 of the MAC and a preamble of 128 us. No EIFS, no end of retries, no time to notice
/// energy.
struct BianchiCell {
    static constexpr std::uint32_t payload = 1023;  ///< [bytes]
    static constexpr BitRate rate{1e6};
    static constexpr Duration preamble = std::chrono::microseconds{128};

    int window = 32;    ///< W [slots]
    int stages = 3;     ///< m
    bool asks = false;  ///< RTS and CTS go ahead of the data

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
        return {.timing = {.slot = 50us,
                           .sifs = 28us,
                           .difs = 128us,
                           .cca_time = 0us,
                           .turnaround = 0us,
                           .rx_start_delay = 0us,
                           .cw_min = window - 1,
                           .cw_max = (window << stages) - 1,
                           .lowest_rate = rate},
                .basic_rates = {rate},
                .eifs = EifsRule::none,
                .short_retries = 0,
                .long_retries = 0,
                .rts_threshold = asks ? 0U : 100'000U,
                .header = 34};
    }
};

/// A cell of 802.11b at 1 Mb/s in which all send broadcasts of 1000 bytes: nothing is answered or
/// repeated, the window stays at 32 slots. A station whose draw is 0 sends at once behind its last
/// frame, which the theory leaves out: it holds up to some 10 stations.
struct BroadcastCell {
    static constexpr std::uint32_t payload = 1000;  ///< [bytes]
    static constexpr BitRate rate{1e6};

    std::uint32_t header = data_header_bytes;  ///< [bytes]

    Csma csma() const { return {.eifs = EifsRule::none, .header = header}; }
    /// Share of the time in which payload reaches a station, of `n` that send.
    double throughput(int n) const {
        constexpr double preamble = 192, difs = 50;
        const double busy = preamble + 8 * (payload + header) + difs;
        const Bianchi cell{.window = 32,
                           .stages = 0,
                           .slot = 20,
                           .payload = 8 * payload,
                           .success = busy,
                           .collision = busy};
        return cell.throughput(n, 2.0 / (cell.window + 1));
    }
};

}  // namespace rovernet
