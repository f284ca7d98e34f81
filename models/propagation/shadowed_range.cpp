// SPDX-License-Identifier: MIT
#include "models/propagation/shadowed_range.hpp"

#include <limits>

namespace rovernet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t all_draws = std::uint32_t{1} << 31;

/// Relative bound on the rounding error of a loss, from log10 to the sum; the actual error is below
/// 1 % of it.
constexpr double rounding = 1e-13;

/// Standard normal distribution function.
double normal_probability(double z) {
    constexpr double sqrt_half = 0.70710678118654752440;
    return 0.5 * math::erfc(-sqrt_half * z);
}

// Draw q represents the probabilities from q 2^-31 to (q + 1) 2^-31. One additional draw covers the
// rounding of z, of erfc and of normal(): together below 1e-13 of probability.

/// Number of draws that are certainly below z.
std::uint32_t draws_below(double z) {
    if (z >= ShadowedLoss::cut_sigmas) return all_draws;
    if (!(z > -ShadowedLoss::cut_sigmas)) return 0;
    return static_cast<std::uint32_t>(std::max(0.0, normal_probability(z) * all_draws - 1));
}

/// Number of the first draw that, like all later ones, is certainly above z.
std::uint32_t draws_up_to(double z) {
    if (z < -ShadowedLoss::cut_sigmas) return 0;
    if (!(z < ShadowedLoss::cut_sigmas)) return all_draws;
    const double draws = normal_probability(z) * all_draws + 2;
    return static_cast<std::uint32_t>(std::min<double>(all_draws, draws));
}

}  // namespace

ShadowedRange::ShadowedRange(const ShadowedLoss& loss, Db budget)
    : loss_(loss), budget_(budget.value) {
    choose_cells();
    double nearest = 0;
    for (std::uint64_t number = first_; number < last_; ++number) {
        const std::uint64_t next = (number + 1) << shift_;
        cells_.push_back(fill(nearest, std::bit_cast<double>(next - 1)));
        nearest = std::bit_cast<double>(next);
    }
    cells_.push_back(fill(nearest, infinity));
}

/// Sets the smallest cells that their number allows, between the squared distances at which the
/// draw matters.
void ShadowedRange::choose_cells() {
    constexpr double margin = 1e-9;  // of the rounding of distance()
    const double cut = ShadowedLoss::cut_sigmas * loss_.sigma;
    const double low = loss_.distance(budget_ - cut), high = loss_.distance(budget_ + cut);
    const auto from = std::bit_cast<std::uint64_t>(low * low * (1 - margin));
    const auto to = std::bit_cast<std::uint64_t>(high * high * (1 + margin));
    const auto most = std::bit_cast<std::uint64_t>(infinity);
    do {
        ++shift_;
        first_ = std::max(from >> shift_, std::uint64_t{1}) - 1;
        last_ = std::min((to >> shift_) + 1, most >> shift_);
    } while (last_ - first_ >= most_cells);
}

/// Cell of the squared distances [m^2] from `nearest` to `farthest`.
ShadowedRange::Cell ShadowedRange::fill(double nearest, double farthest) const {
    if (!(budget_ >= 0)) return {.sure = 0, .open = 0};
    // Number of sigmas by which the median may exceed the budget; `sign` is the sign of the
    // rounding.
    const auto margin = [&](double squared_distance, double sign) {
        const double rise = loss_.rise(std::sqrt(squared_distance));
        const double terms =
            std::abs(loss_.at_reference) + rise + ShadowedLoss::cut_sigmas * loss_.sigma;
        return (budget_ - (loss_.at_reference + rise) + sign * rounding * terms) / loss_.sigma;
    };
    const std::uint32_t sure = draws_below(margin(farthest, -1));
    return {.sure = sure, .open = draws_up_to(margin(nearest, +1)) - sure};
}

bool ShadowedRange::computed(double squared_distance, std::uint64_t bits) const {
    return loss_(std::sqrt(squared_distance), PairDraws::normal_of(bits)) <= budget_;
}

}  // namespace rovernet
