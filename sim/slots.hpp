// SPDX-License-Identifier: MIT
#pragma once

#include "sim/chunks.hpp"

#include <cstddef>
#include <vector>

// Places that are given by number to what is on its way: frames in flight, actions, legs. An event
// carries the number, where a pointer would not fit.

namespace rovernet {

/// Numbered places for values that come and go, such as frames in flight. A place that was released
/// is used again, and a value stays where it is while others come: references stay valid. Memory
/// grows only beyond the most places that were ever taken at once.
///
///   const std::size_t slot = flights.take();
///   flights[slot] = ...;
///   flights.release(slot);
///
/// @tparam T  as for Chunks
template <class T>
class Slots {
  public:
    /// Takes a place, the last that was released. It holds what its last user left there, so that
    /// its memory (of a vector, say) may serve again; a new place holds T{}.
    std::size_t take() {
        if (free_.empty()) {
            values_.push_back({});
            return values_.size() - 1;
        }
        const std::size_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    /// Gives a place back, once. Its value stays, unused, until the place is taken again.
    void release(std::size_t slot) { free_.push_back(slot); }

    /// Value in a place that is taken; not checked.
    T& operator[](std::size_t slot) { return values_[slot]; }
    const T& operator[](std::size_t slot) const { return values_[slot]; }

  private:
    // Values of all places, taken or not.
    Chunks<T> values_;
    // Places that were released and not taken again.
    std::vector<std::size_t> free_;
};

}  // namespace rovernet
