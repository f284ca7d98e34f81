// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Set of non-negative integers that counts its members below a number in constant time. It stores
/// a bit for each integer, and a count for every 64 bits.
class CountedBits {
  public:
    CountedBits() = default;
    /// @param members  each below `end`
    CountedBits(std::size_t end, std::span<const std::size_t> members)
        : bits_(end / 64 + 1), before_(bits_.size()) {
        for (const std::size_t n : members) bits_[n / 64] |= std::uint64_t{1} << n % 64;
        for (std::size_t i = 1; i < bits_.size(); ++i)
            before_[i] = before_[i - 1] + static_cast<std::uint32_t>(std::popcount(bits_[i - 1]));
    }
    /// Number of members of the set that are below `n`.
    /// @param n  at most the `end` given to the constructor
    std::size_t below(std::size_t n) const {
        const std::uint64_t lower = (std::uint64_t{1} << n % 64) - 1;
        return before_[n / 64] + static_cast<std::size_t>(std::popcount(bits_[n / 64] & lower));
    }

  private:
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint32_t> before_;  // number of members before each word of bits_
};

}  // namespace rovernet
