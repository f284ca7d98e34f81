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

namespace rovernet {

/// Loss [dB] with log-normal shadowing, of distance d [m] >= 0 and a standard normal draw x:
///   L(d, x) = max(0, median(d) + sigma clamp(x, -5, 5)),
///   median(d) = L0 + S log10(max(d / d0, 1)).
struct ShadowedLoss {
    static constexpr double cut_sigmas = 5;

    double at_reference;        ///< L0 [dB]
    double per_decade;          ///< S [dB], > 0
    double reference_distance;  ///< d0 [m], > 0
    double sigma;               ///< [dB], >= 0

    double rise(double d) const {
        return per_decade * math::log10(std::max(d / reference_distance, 1.0));
    }
    double median(double d) const { return at_reference + rise(d); }
    double operator()(double d, double x) const {
        return std::max(0.0, median(d) + sigma * std::clamp(x, -cut_sigmas, cut_sigmas));
    }
    /// The distance [m] whose median loss is `loss` [dB], but for rounding; at least d0.
    double distance(double loss) const {
        return reference_distance * math::exp10(std::max(0.0, (loss - at_reference) / per_decade));
    }
};

/// The draws x of links, one for each unordered pair of robots' keys.
inline PairDraws shadowing_draws(std::uint64_t seed, std::uint32_t replication) {
    return {seed, replication, Purpose::link_shadowing};
}

/// Which links of one link budget are up, when the loss is a ShadowedLoss of the pair's own draw:
/// the loss's own decision to the last bit, without a logarithm, a square root or a normal draw.
///
/// A table over the squared distance, in cells of equal width between powers of two, tells how many
/// of the 2^31 draws are in range throughout the cell, and how many somewhere. A draw in between is
/// rare (computed_share()) and has its loss computed. At most 16 KiB.
class ShadowedRange {
  public:
    /// @param budget  greatest loss with which a link is up
    ShadowedRange(const ShadowedLoss& loss, Db budget);

    /// The loss is within the budget.
    /// @param squared_distance  of the antennas [m^2], >= 0
    /// @param bits              of the pair's draw, by shadowing_draws() of the run
    bool in_range(double squared_distance, std::uint64_t bits) const {
        const Cell& here = cell(squared_distance);
        const auto draw = static_cast<std::uint32_t>(bits >> 33);
        if (draw - here.sure < here.open) [[unlikely]]
            return computed(squared_distance, bits);
        return draw < here.sure;
    }

    /// Of the draws 0, 1 ... 2^31 - 1, only so many first ones may be in range at squared distances
    /// [m^2] from `at_least` on.
    std::uint32_t most_draws(double at_least) const {
        const Cell& nearest = cell(at_least);
        return nearest.sure + nearest.open;
    }

    /// Probability [-] that a link of this squared distance [m^2] has to be computed.
    double computed_share(double squared_distance) const {
        return cell(squared_distance).open * 0x1p-31;
    }

  private:
    static constexpr std::uint64_t most_cells = 2048;

    /// Of the draws 0, 1 ... 2^31 - 1, low ones for low losses, the first `sure` are in range and
    /// the next `open` not everywhere in the cell.
    struct Cell {
        std::uint32_t sure;
        std::uint32_t open;
    };

    void choose_cells();
    Cell fill(double nearest, double farthest) const;
    bool computed(double squared_distance, std::uint64_t bits) const;
    const Cell& cell(double squared_distance) const {
        // Non-negative numbers are in the order of their bits.
        const std::uint64_t number = std::bit_cast<std::uint64_t>(squared_distance) >> shift_;
        return cells_[std::clamp(number, first_, last_) - first_];
    }

    ShadowedLoss loss_;
    double budget_;
    int shift_ = 0;            // bits of a squared distance that its cell's number leaves out
    std::uint64_t first_ = 0;  // number of the first cell, which begins at 0
    std::uint64_t last_ = 0;   // number of the last cell, which has no end
    std::vector<Cell> cells_;
};

/// A first look at pairs that rules out most of those that are out of range: coarser than
/// ShadowedRange and cheaper.
class FirstLook {
  public:
    /// @param squared_reach  [m^2] nobody farther is in range
    explicit FirstLook(double squared_reach) : scale_(static_cast<float>(cells / squared_reach)) {}

    /// Lets those pass, too, that are in `range`.
    void let_pass(const ShadowedRange& range) {
        for (std::size_t i = 0; i < most_draws_.size(); ++i) {
            // Its nearer edge, but for rounding.
            const double nearest = i == 0 ? 0 : (1 - 1e-6) * static_cast<double>(i) / scale_;
            most_draws_[i] = std::max(most_draws_[i], range.most_draws(nearest));
        }
    }
    /// False only if pairs of these bits of the draws are out of range at all squared distances
    /// [m^2] from `at_least` on, >= 0.
    bool passes(float at_least, std::uint64_t bits) const {
        const float scaled = at_least * scale_;
        const auto cell = static_cast<std::int32_t>(scaled < cells ? scaled : cells);
        return bits >> 33 < most_draws_[static_cast<std::size_t>(cell)];
    }

  private:
    static constexpr std::uint16_t cells = 255;  // the last one has no end

    float scale_;  // [1/m^2]
    std::array<std::uint32_t, cells + 1> most_draws_{};
};

}  // namespace rovernet
