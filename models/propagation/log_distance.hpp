// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

namespace rovernet {

/// Log-distance path loss [dB] with log-normal shadowing of the link:
///
///   L(d) = L0 + 10 n log10(d / d0) + X,   L0 + X for d <= d0,   with L0 = free space at d0 +
///   excess; X normal with mean 0 and standard deviation sigma, cut at 5 sigma; the sum is never
///   negative.
///
/// X is a function of seed, replication and the unordered pair of robots: X is equal in both
/// directions, at all times and for any number of samples. The cut (5.7e-7 of draws) bounds the
/// range; ShadowedRange uses this bound to decide links fast. Valid in the far field of the
/// transmitter. n and sigma include walls: single walls have no effect. Median with the defaults at
/// 2450 MHz, by `rovernet loss log_distance`:
///
///   1 m   40.23 dB
///   10 m  65.23 dB
///
/// Source: T. S. Rappaport, Wireless Communications, 2nd ed., section 4.9.
struct LogDistance {
    static constexpr std::string_view name = "log_distance";

    /// Path loss exponent n [-], > 0: 2 in free space, about 4 in an obstructed office.
    double exponent = 2.5;
    /// Standard deviation of the shadowing X [dB], >= 0; with 0 the loss is the median.
    Db sigma{5};
    /// Reference distance d0 [m], > 0.
    Meters reference_distance{1.0};
    /// Loss at the reference distance in addition to free space [dB]; may be negative.
    Db excess{0};

    static constexpr auto fields() {
        return describe(
            field("exponent", &LogDistance::exponent, positive,
                  "n, path loss exponent: 2 in free space, about 4 in an obstructed office")
                .linear(2),
            field("sigma", &LogDistance::sigma, non_negative,
                  "standard deviation of the shadowing of links; 0: the loss is the median")
                .spread(),
            field("reference_distance", &LogDistance::reference_distance, positive,
                  "reference distance d0; at shorter distances, the median loss equals the median "
                  "loss at d0"),
            field("excess", &LogDistance::excess,
                  "loss at d0 in addition to the loss of free space; `rovernet fit` can determine "
                  "this loss")
                .constant(far_from_zero));
    }

    /// Shape of the loss: by_pair with shadowing, otherwise by_distance.
    LossShape shape() const {
        return sigma.value == 0 ? LossShape::by_distance : LossShape::by_pair;
    }

    /// Whether the loss has a random part for each pair of robots.
    bool is_random() const { return sigma.value > 0; }
    /// Model with the same parameters, but without shadowing (sigma 0).
    LogDistance median() const { return {exponent, Db{0}, reference_distance, excess}; }
    /// Path loss at a frequency, as a function of distance and shadowing draw.
    ShadowedLoss shadowed_loss(Hertz f) const;
    /// Distance [m] beyond which the loss is more than `loss`, even with a shadowing of -5 sigma.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i, with the shadowing draw of the pair.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;
};

}  // namespace rovernet
