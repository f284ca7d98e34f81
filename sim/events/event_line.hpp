// SPDX-License-Identifier: MIT
#pragma once

#include "sim/events/event_heap.hpp"

#include <cstddef>
#include <span>
#include <vector>

// Sorted list of the event queue, for keys that arrive nearly in order.

namespace rovernet {

/// Sorted list of event keys, for keys that arrive nearly in order. A key is inserted at most 8
/// places from the end; a group of up to 48 keys that are later than all stored keys is appended in
/// one step. Removing the first key takes one addition.
///
/// EventQueue has two lines: one for the ends of frames, whose order is nearly the order of their
/// starts because frames last about equally long; and one for the earliest of the other events.
class EventLine {
  public:
    /// Largest number of keys in a group; append() counts with 6 bits.
    static constexpr std::size_t most_at_once = 48;

    /// Whether the line has no key; front() is then the default key.
    bool empty() const { return front() == EventKey{}; }
    /// Number of keys, without the removed ones.
    std::size_t size() const { return keys_.size() - 1 - front_; }
    /// Smallest key: key of the earliest event; the default key if the line is empty.
    EventKey front() const { return keys_[front_]; }

    /// Inserts a key, unless more than 8 stored keys come after it.
    /// @return whether the key was inserted; if not, the caller has to store it elsewhere
    bool push(EventKey key) {
        std::size_t place = keys_.size() - 1;
        const std::size_t first = size() > few ? place - few : front_;
        while (place > first && key < keys_[place - 1]) --place;
        if (place == first && place > front_ && key < keys_[place - 1]) return false;
        keys_.push_back({});
        for (std::size_t i = keys_.size() - 1; i > place; --i) keys_[i] = keys_[i - 1];
        keys_[place] = key;
        if (front_ >= most_gone && 2 * front_ >= keys_.size()) [[unlikely]]
            forget_gone();
        return true;
    }
    /// Appends a group of keys, in any order, that are all later than the keys in the line.
    /// @param group  1 to most_at_once keys
    /// @param first  a time not after any key of the group
    /// @param bits   times of the group differ from `first` by less than 2^bits ns
    void append(std::span<const EventKey> group, Time first, int bits);
    /// Removes front() if `remove` is true; the line must then have a key. Without a branch, for
    /// callers that cannot predict which of two lines has the next event.
    void pop_if(bool remove) { front_ += remove; }
    /// Removes every key for which keep(key) is false, in a time O(n).
    template <class Keep>
    void filter(Keep keep) {
        forget_gone();
        std::erase_if(keys_, [&](EventKey key) { return key != EventKey{} && !keep(key); });
    }

  private:
    // Number of places from the end that push() compares with.
    static constexpr std::size_t few = 8;
    // Number of removed keys that are kept before memory is compacted.
    static constexpr std::size_t most_gone = 64;

    // Frees the memory of removed keys.
    void forget_gone() {
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
    }

    // Keys, sorted from front_ on; the default key is the last entry.
    std::vector<EventKey> keys_ = std::vector<EventKey>(1);
    // Index of the smallest key; the keys before it were removed.
    std::size_t front_ = 0;
};

}  // namespace rovernet
