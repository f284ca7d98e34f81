// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

// Bounds of path losses. If two frames overlap, usually one is much stronger: the bounds then show
// which one, without computing the levels.

namespace rovernet {

/// Bounds of a path loss that never decreases with distance: the exact loss at a few distances,
/// each computed when first needed.
///
/// If the bounds of two losses do not overlap, comparing them needs no logarithm. RadioKinds
/// has a LossBounds for each kind of station; Arrivals::is_stronger uses it.
///
///   const auto [low, high] = bounds.at(d2, [&](double d) { return loss_at(model, f, d); });
class LossBounds {
  public:
    /// Lower and upper bound of a path loss.
    struct Bounds {
        /// Lower and upper bound [dB].
        double low, high;
    };

    /// Bounds of the loss [dB] at a distance; infinite below 1 m and beyond 131 km.
    /// @param squared_distance  [m^2] >= 0
    /// @param loss_at           loss [dB] at a distance [m]
    template <class LossAt>
    Bounds at(double squared_distance, LossAt loss_at) {
        // Non-negative floating-point numbers are ordered like their bits.
        const std::uint64_t cell = std::bit_cast<std::uint64_t>(squared_distance) >> shift;
        if (cell < first || cell >= first + cells) return {-infinity, infinity};
        if (edges_.empty()) edges_.resize(cells + 1, unknown);
        return {edge(cell, loss_at) - rounding, edge(cell + 1, loss_at) + rounding};
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    // Margin [dB], larger than the rounding error of any loss.
    static constexpr double rounding = 1e-9;
    // Number of low bits of a squared distance that a cell number omits. There are 64 cells of
    // equal width between each power of two [m^2] and the next, from 1 m to 131 km.
    static constexpr int shift = 46;
    // Number of the first cell, which begins at 1 m^2, and number of cells.
    static constexpr std::uint64_t first = std::bit_cast<std::uint64_t>(1.0) >> shift;
    static constexpr std::uint64_t cells = 34 * 64;

    // Loss at the lower end of cell `number` [dB].
    template <class LossAt>
    double edge(std::uint64_t number, LossAt loss_at) {
        double& edge = edges_[number - first];
        if (std::isnan(edge)) [[unlikely]]
            edge = loss_at(std::sqrt(std::bit_cast<double>(number << shift)));
        return edge;
    }

    // Losses at the lower ends of the cells [dB]; NaN if not computed yet.
    std::vector<double> edges_;
};

}  // namespace rovernet
