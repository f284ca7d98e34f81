// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rovernet {

/// The order of a few numbers that are spread about evenly, without comparing them: each takes a
/// seat in a row, at its share of the largest; its rank is how many seats before it are taken. So
/// the order is right but for numbers that wanted the same seat or were pushed on by others.
class RoughRanks {
  public:
    static constexpr std::size_t most = 128;     ///< numbers
    static constexpr std::uint32_t seats = 896;  ///< that may be wanted

    /// Takes the first seat from `wanted` on that is free. @return the seat
    std::uint32_t take(std::uint32_t wanted) {
        assert(wanted < seats);
        std::uint32_t seat = wanted;
        while (taken_[seat / 64] >> seat % 64 & 1) ++seat;
        taken_[seat / 64] |= std::uint64_t{1} << seat % 64;
        return seat;
    }
    /// To be called once all have their seats.
    void count() {
        std::uint32_t before = 0;
        for (std::size_t word = 0; word < taken_.size(); ++word) {
            before_[word] = std::exchange(before, before + count_ones(taken_[word]));
        }
    }
    /// How many seats before it are taken.
    std::uint32_t rank(std::uint32_t seat) const {
        const std::uint64_t below = (std::uint64_t{1} << seat % 64) - 1;
        return before_[seat / 64] + count_ones(taken_[seat / 64] & below);
    }

  private:
    static std::uint32_t count_ones(std::uint64_t word) {
        return static_cast<std::uint32_t>(std::popcount(word));
    }

    // So many more than may be wanted that nobody is pushed off the end.
    std::array<std::uint64_t, (seats + most) / 64> taken_{};
    std::array<std::uint32_t, (seats + most) / 64> before_;
};

}  // namespace rovernet
