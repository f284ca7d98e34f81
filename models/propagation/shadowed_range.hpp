// SPDX-License-Identifier: MIT
#pragma once

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

// Links under shadowing, decided without computing their loss. A draw belongs to each pair of
// robots; most draws decide a link by the distance alone, and a table tells which. A model takes
// part by its shadowed_loss().

namespace rovernet {

/// Loss [dB] with log-normal shadowing, of distance d [m] >= 0 and a standard normal draw x:
///
///   L(d, x) = max(0, median(d) + sigma clamp(x, -5, 5)),
///   median(d) = L0 + S log10(max(d / d0, 1)).
struct ShadowedLoss {
    /// Standard deviations at which draws are cut [-].
    static constexpr double cut_sigmas = 5;

    /// Loss at the reference distance, L0 [dB].
    double at_reference;
    /// Slope S [dB per decade of distance], > 0.
    double per_decade;
    /// Reference distance d0 [m], > 0.
    double reference_distance;
    /// Standard deviation of shadowing [dB], >= 0.
    double sigma;

    /// Median loss at d above that at the reference distance [dB].
    double rise(double d) const {
        return per_decade * math::log10(std::max(d / reference_distance, 1.0));
    }
    /// Median loss [dB].
    double median(double d) const { return at_reference + rise(d); }
    /// Loss with the draw x [dB].
    double operator()(double d, double x) const {
        return std::max(0.0, median(d) + sigma * std::clamp(x, -cut_sigmas, cut_sigmas));
    }
    /// Distance [m] whose median loss is `loss` [dB], but for rounding; at least d0.
    double distance(double loss) const {
        return reference_distance * math::exp10(std::max(0.0, (loss - at_reference) / per_decade));
    }
};

/// Draws x of links, one for each unordered pair of robots' keys.
inline PairDraws shadowing_draws(std::uint64_t seed, std::uint32_t replication) {
    return {seed, replication, Purpose::link_shadowing};
}

/// Table that decides which links of one link budget are up, when the loss is a ShadowedLoss of the
/// pair's own draw: the loss's own decision to the last bit, without a logarithm, a square root or
/// a normal draw.
///
/// The table is over the squared distance, in cells of equal width between powers of two. A cell
/// tells how many of the 2^31 draws are in range throughout it, and how many somewhere. A draw in
/// between is rare (computed_share()) and has its loss computed. A table takes 16 KiB at most; the
/// medium keeps one for each pair of kinds of radios.
class ShadowedRange {
  public:
    /// @param budget  greatest loss with which a link is up
    ShadowedRange(const ShadowedLoss& loss, Db budget);

    /// Whether the loss is within the budget.
    /// @param squared_distance  of the antennas [m^2], >= 0
    /// @param bits              of the pair's draw, by shadowing_draws() of the run
    bool in_range(double squared_distance, std::uint64_t bits) const {
        const Cell& here = cell(squared_distance);
        const auto draw = static_cast<std::uint32_t>(bits >> 33);
        if (draw - here.sure < here.open) [[unlikely]]
            return computed(squared_distance, bits);
        return draw < here.sure;
    }

    /// Number of draws that may be in range at squared distances [m^2] from `at_least` on: of the
    /// draws 0, 1 ... 2^31 - 1 only so many first ones. FirstLook is made of it.
    std::uint32_t most_draws(double at_least) const {
        const Cell& nearest = cell(at_least);
        return nearest.sure + nearest.open;
    }

    /// Probability [-] that a link of this squared distance [m^2] has to be computed: what the
    /// table leaves open there.
    double computed_share(double squared_distance) const {
        return cell(squared_distance).open * 0x1p-31;
    }

  private:
    // Cells of a table at most: 16 KiB.
    static constexpr std::uint64_t most_cells = 2048;

    /// Cell of the table. Of the draws 0, 1 ... 2^31 - 1, low ones for low losses, the first `sure`
    /// are in range and the next `open` not everywhere in the cell.
    struct Cell {
        std::uint32_t sure;
        std::uint32_t open;
    };

    // Chooses the width of cells: as narrow as their number allows.
    void choose_cells();
    // Cell of the squared distances [m^2] from `nearest` to `farthest`.
    Cell fill(double nearest, double farthest) const;
    // Decision by the loss itself, for draws that the table leaves open.
    bool computed(double squared_distance, std::uint64_t bits) const;
    // Cell of a squared distance [m^2].
    const Cell& cell(double squared_distance) const {
        // Non-negative numbers are in the order of their bits.
        const std::uint64_t number = std::bit_cast<std::uint64_t>(squared_distance) >> shift_;
        return cells_[std::clamp(number, first_, last_) - first_];
    }

    // Loss that is decided on.
    ShadowedLoss loss_;
    // Greatest loss with which a link is up [dB].
    double budget_;
    // Bits of a squared distance that the number of its cell leaves out.
    int shift_ = 0;
    // Number of the first cell, which begins at 0, and of the last, which has no end.
    std::uint64_t first_ = 0;
    std::uint64_t last_ = 0;
    // Cells from the first number to the last.
    std::vector<Cell> cells_;
};

/// First look at pairs that rules out most of those that are out of range: coarser than
/// ShadowedRange and cheaper, with one table for all kinds of receivers of a sender. Under
/// shadowing many more robots are near enough for the luckiest draw than hear a frame; most are
/// ruled out here, by a comparison of two integers.
class FirstLook {
  public:
    /// @param squared_reach  squared distance [m^2] beyond which nobody is in range
    explicit FirstLook(double squared_reach) : scale_(static_cast<float>(cells / squared_reach)) {}

    /// Lets those pass, too, that are in `range`.
    void let_pass(const ShadowedRange& range) {
        for (std::size_t i = 0; i < most_draws_.size(); ++i) {
            // Its nearer edge, but for rounding.
            const double nearest = i == 0 ? 0 : (1 - 1e-6) * static_cast<double>(i) / scale_;
            most_draws_[i] = std::max(most_draws_[i], range.most_draws(nearest));
        }
    }
    /// Whether a pair with these bits of its draw may be in range at squared distances [m^2] from
    /// `at_least` >= 0 on; if not, it is out of range at all of them.
    bool passes(float at_least, std::uint64_t bits) const {
        const float scaled = at_least * scale_;
        const auto cell = static_cast<std::int32_t>(scaled < cells ? scaled : cells);
        return bits >> 33 < most_draws_[static_cast<std::size_t>(cell)];
    }

  private:
    // Cells of equal width; one more has no end.
    static constexpr std::uint16_t cells = 255;

    // Cells in a square metre [1/m^2].
    float scale_;
    // Number of draws that may be in range, by cell.
    std::array<std::uint32_t, cells + 1> most_draws_{};
};

}  // namespace rovernet
