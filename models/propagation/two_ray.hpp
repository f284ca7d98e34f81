// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

namespace rovernet {

/// Two-ray ground reflection, simplified:
///   L(d) = free space + max(0, 20 log10(d / dc)),   dc = 4 pi ht hr / lambda,   never negative:
/// beyond the crossover dc this is d^4 / (ht hr)^2, whatever the frequency.
///
/// d is the distance between the antennas, ht and hr are their heights: their z above a flat ground
/// at z = 0. An antenna below `lowest_antenna`, or below the ground, counts as that high; the
/// equation would lose everything at height 0. Valid over open, flat ground that reflects without
/// loss, for heights of a wavelength and more and d well above ht + hr. Leaves out the peaks and
/// nulls of the two rays before the crossover (39 dB deep in the last one for 1.5 m at 2.4 GHz),
/// walls and every obstacle.
/// Source: T. S. Rappaport, Wireless Communications, 2nd ed., section 4.6, with the crossover of
/// the ns-2 manual, section 18.2.
struct TwoRay {
    static constexpr std::string_view name = "two_ray";

    Meters lowest_antenna{0.1};  ///< [m] above the ground, > 0

    static constexpr auto fields() {
        return describe(field("lowest_antenna", &TwoRay::lowest_antenna, positive,
                              "height above z = 0 that a lower antenna counts as having"));
    }

    LossShape shape() const { return LossShape::by_heights; }

    /// No antenna is higher than `highest`: the loss is never less than that of free space, nor
    /// than that between two antennas of that height beyond their crossover, 40 log10(d / h).
    Meters reach(Db loss, Hertz f, Meters highest) const;
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;
};

}  // namespace rovernet
