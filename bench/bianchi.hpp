// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace rovernet::bench {

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

}  // namespace rovernet::bench
