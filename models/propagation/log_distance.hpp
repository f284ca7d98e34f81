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
/// X is a function of seed, replication and the unordered pair of robots: the same in both
/// directions, at every time and for every number of looks. The cut (5.7e-7 of draws) bounds the
/// range; ShadowedRange decides links by it fast. Valid in the far field of the transmitter; walls
/// are in n and sigma, not seen one by one. The median with the defaults at 2450 MHz, by `rovernet
/// loss log_distance`:
///
///   1 m   40.23 dB
///   10 m  65.23 dB
///
/// Source: T. S. Rappaport, Wireless Communications, 2nd ed., section 4.9.
struct LogDistance {
    static constexpr std::string_view name = "log_distance";

    /// Path loss exponent n [-], > 0; 2 free space, about 4 an obstructed office.
    double exponent = 2.5;
    /// Standard deviation of X [dB], >= 0; 0 for the median alone.
    Db sigma{5};
    /// Reference distance d0 [m], > 0.
    Meters reference_distance{1.0};
    /// Loss at d0 beyond that of free space [dB]; may be negative.
    Db excess{0};

    static constexpr auto fields() {
        return describe(field("exponent", &LogDistance::exponent, positive,
                              "n, path loss exponent: 2 free space, about 4 an obstructed office"),
                        field("sigma", &LogDistance::sigma, non_negative,
                              "standard deviation of the link's shadowing; 0 for the median"),
                        field("reference_distance", &LogDistance::reference_distance, positive,
                              "d0, below which the loss is held"),
                        field("excess", &LogDistance::excess,
                              "loss at d0 beyond that of free space; what a fit finds"));
    }

    /// By pair with shadowing, else by distance: no wall is looked at.
    LossShape shape() const {
        return sigma.value == 0 ? LossShape::by_distance : LossShape::by_pair;
    }

    /// Whether pairs draw a part of their loss.
    bool is_random() const { return sigma.value > 0; }
    /// Model with sigma 0.
    LogDistance median() const { return {exponent, Db{0}, reference_distance, excess}; }
    /// Loss as a function of distance and draw, at a frequency.
    ShadowedLoss shadowed_loss(Hertz f) const;
    /// Distance [m] beyond which the loss is more than `loss` even for a draw of -5 sigma.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] [dB] for the i-th receiver, with the draw of the pair.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;
};

}  // namespace rovernet
