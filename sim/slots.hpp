// SPDX-License-Identifier: MIT
#pragma once

#include "sim/chunks.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Numbered places for values that come and go: freed places are used again, and a value stays
/// where it is while others come. Grows only beyond the most that were ever taken at once.
template <class T>
class Slots {
  public:
    /// Takes a place; it holds what its last user left there, whose memory may serve again.
    std::size_t take() {
        if (free_.empty()) {
            values_.push_back({});
            return values_.size() - 1;
        }
        const std::size_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    void release(std::size_t slot) { free_.push_back(slot); }

    T& operator[](std::size_t slot) { return values_[slot]; }
    const T& operator[](std::size_t slot) const { return values_[slot]; }

  private:
    Chunks<T> values_;
    std::vector<std::size_t> free_;
};

}  // namespace rovernet
