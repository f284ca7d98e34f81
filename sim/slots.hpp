// SPDX-License-Identifier: MIT
#pragma once

#include "sim/chunks.hpp"

#include <cstddef>
#include <vector>

// Numbered places for temporary objects: frames in flight, actions, legs. An event stores the
// number, because a pointer would be too large.

namespace rovernet {

/// Numbered slots for temporary values, such as frames in flight. Released slots are reused. Values
/// do not move: references stay valid. Memory follows the largest number of slots in use.
///
///   const std::size_t slot = flights.take();
///   flights[slot] = ...;
///   flights.release(slot);
///
/// @tparam T  default-constructible and movable, see Chunks
template <class T>
class Slots {
  public:
    /// Takes an unused slot, the last one that was released. @return number of the slot. The slot
    /// contains the value of its last user, whose memory (of a vector, for example) can be reused;
    /// a new slot contains T{}.
    std::size_t take() {
        if (free_.empty()) {
            values_.push_back({});
            return values_.size() - 1;
        }
        const std::size_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    /// Releases a slot that is in use. Its value stays, unused, until the slot is taken again.
    void release(std::size_t slot) { free_.push_back(slot); }

    /// Value in a slot that is in use; not checked.
    T& operator[](std::size_t slot) { return values_[slot]; }
    const T& operator[](std::size_t slot) const { return values_[slot]; }

  private:
    // Values of all slots, in use or free.
    Chunks<T> values_;
    // Numbers of the free slots.
    std::vector<std::size_t> free_;
};

}  // namespace rovernet
