// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Link decisions under shadowing without computing the loss. Each pair of robots has a random draw
// of the shadowing. For most draws, a table decides from the distance whether the link is up. A
// model supports such tables by shadowed_loss().

namespace rovernet {

/// Standard normal draws x of the shadowing, one for each unordered pair of robots' keys.
inline PairDraws shadowing_draws(std::uint64_t seed, std::uint32_t replication) {
    return {seed, replication, Purpose::link_shadowing};
}

/// Table that decides whether a link is within a link budget, for a ShadowedLoss and the pair's
/// draw: exactly the decision of the loss, without a logarithm, a square root or a normal draw.
///
/// The table is over the squared distance, in cells of equal width between powers of two. A cell
/// stores two counts of the 2^31 possible draws: draws that are in range everywhere in the cell,
/// and further draws that are in range only in a part of the cell. For one of the further draws,
/// which is rare (computed_share()), the loss is computed. A table takes at most 16 KiB; the medium
/// stores one for each pair of radio kinds.
class ShadowedRange {
  public:
    /// @param budget  largest path loss at which a link is up
    ShadowedRange(const ShadowedLoss& loss, Db budget);

    /// Whether the loss of a link is within the budget.
    /// @param squared_distance  squared distance of the antennas [m^2], >= 0
    /// @param bits              bits of the pair's draw, from shadowing_draws() of the run
    bool in_range(double squared_distance, std::uint64_t bits) const {
        const Cell& here = cell(squared_distance);
        const auto draw = static_cast<std::uint32_t>(bits >> 33);
        if (draw - here.sure < here.open) [[unlikely]]
            return computed(squared_distance, bits);
        return draw < here.sure;
    }

    /// Number n of draws that may be in range at squared distances [m^2] >= `at_least`: the draws
    /// 0, 1 ... n - 1 of 2^31. FirstLook uses this number.
    std::uint32_t most_draws(double at_least) const {
        const Cell& nearest = cell(at_least);
        return nearest.sure + nearest.open;
    }

    /// Probability [-] that the loss of a link at this squared distance [m^2] has to be computed,
    /// because the table does not decide.
    double computed_share(double squared_distance) const {
        return cell(squared_distance).open * 0x1p-31;
    }

  private:
    // Largest number of cells of a table: 16 KiB.
    static constexpr std::uint64_t most_cells = 2048;

    /// Cell of the table: an interval of squared distances. Draws 0, 1 ... 2^31 - 1 are in
    /// ascending order of loss: the first `sure` draws are in range in the whole cell, the next
    /// `open` draws only in a part of the cell.
    struct Cell {
        std::uint32_t sure;
        std::uint32_t open;
    };

    // Chooses the smallest width of cells for which the table has at most most_cells cells.
    void choose_cells();
    // Computes the counts of draws for the cell that contains the squared distances [m^2] from
    // `nearest` to `farthest`.
    Cell fill(double nearest, double farthest) const;
    // Whether the loss of a link is within the budget, by computing the loss. Used for draws that
    // the table does not decide.
    bool computed(double squared_distance, std::uint64_t bits) const;
    // Cell of the table that contains a squared distance [m^2].
    const Cell& cell(double squared_distance) const {
        // Non-negative floating-point numbers are ordered like their bits.
        const std::uint64_t number = std::bit_cast<std::uint64_t>(squared_distance) >> shift_;
        return cells_[std::clamp(number, first_, last_) - first_];
    }

    // Path loss that is compared with the budget.
    ShadowedLoss loss_;
    // Largest loss at which a link is up [dB].
    double budget_;
    // Number of low bits that are dropped from the bits of a squared distance (a double). The
    // remaining bits are the number of the table's cell.
    int shift_ = 0;
    // Number of the first cell, which begins at distance 0, and of the last cell, which has no
    // upper end.
    std::uint64_t first_ = 0;
    std::uint64_t last_ = 0;
    // Cells with the numbers first_ to last_.
    std::vector<Cell> cells_;
};

/// First test that excludes most pairs out of range: coarser and faster than ShadowedRange, with
/// one table for all kinds of receivers of a sender. Under shadowing, only few of the robots within
/// the range of the most favourable draw are receivers. A comparison of two integers excludes most
/// of the remaining robots.
class FirstLook {
  public:
    /// @param squared_reach  square of the largest distance [m^2] at which a receiver is in range
    explicit FirstLook(double squared_reach) : scale_(static_cast<float>(cells / squared_reach)) {}

    /// Extends the test: pairs that may be in range by `range` now pass the test, too.
    void let_pass(const ShadowedRange& range) {
        for (std::size_t i = 0; i < most_draws_.size(); ++i) {
            // Nearer edge of the cell, with a margin for rounding.
            const double nearest = i == 0 ? 0 : (1 - 1e-6) * static_cast<double>(i) / scale_;
            most_draws_[i] = std::max(most_draws_[i], range.most_draws(nearest));
        }
    }
    /// Whether a pair of robots may be in range at any squared distance [m^2] >= `at_least` >= 0.
    /// `bits` are the bits of the pair's draw.
    bool passes(float at_least, std::uint64_t bits) const {
        const float scaled = at_least * scale_;
        const auto cell = static_cast<std::int32_t>(scaled < cells ? scaled : cells);
        return bits >> 33 < most_draws_[static_cast<std::size_t>(cell)];
    }

  private:
    // Number of cells of equal width; one more cell is unbounded.
    static constexpr std::uint16_t cells = 255;

    // Number of cells per square metre of squared distance [1/m^2].
    float scale_;
    // Number n of draws that may be in range in each cell: the draws 0, 1 ... n - 1 of 2^31.
    std::array<std::uint32_t, cells + 1> most_draws_{};
};

}  // namespace rovernet
