// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"

#include <cstddef>
#include <span>
#include <vector>

// Half of the event queue: keys that come nearly in order need no heap.

namespace rovernet {

/// Sorted run of event keys, for keys that come nearly in order. A key is inserted at most 8 places
/// from the end; a group of up to 48 keys that are later than all others is appended at once.
/// Removing the first costs an addition.
///
/// EventQueue has two: one for the ends of frames, which come nearly in the order in which the
/// frames began because frames last about equally long, and one for the nearest of the other
/// events.
class EventLine {
  public:
    /// Keys in a group at most; append() counts with 6 bits.
    static constexpr std::size_t most_at_once = 48;

    /// Whether there is no key: the default key stands in front.
    bool empty() const { return front() == EventKey{}; }
    /// Number of keys, those that were removed left out.
    std::size_t size() const { return keys_.size() - 1 - front_; }
    /// Least key; the default key if the line is empty.
    EventKey front() const { return keys_[front_]; }

    /// Inserts a key, unless it belongs before more than 8 others.
    /// @return whether it was inserted; if not, the caller has to keep it elsewhere
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
    /// Appends keys, in any order among themselves, that are later than all in the line.
    /// @param group  1 to most_at_once keys
    /// @param first  a time not after any of theirs
    /// @param bits   their times differ from `first` by less than 2^bits ns
    void append(std::span<const EventKey> group, Time first, int bits);
    /// Removes front(), if `remove` is true; there must be a key then. It takes no branch, for
    /// callers that do not know from which of two lines the next event comes.
    void pop_if(bool remove) { front_ += remove; }
    /// Removes every key for which keep(key) is false. It takes O(n).
    template <class Keep>
    void filter(Keep keep) {
        forget_gone();
        std::erase_if(keys_, [&](EventKey key) { return key != EventKey{} && !keep(key); });
    }

  private:
    // Places from the end that push() looks at.
    static constexpr std::size_t few = 8;
    // Places of removed keys that may always be left unused.
    static constexpr std::size_t most_gone = 64;

    // Gives back the places of the keys that were removed.
    void forget_gone() {
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
    }

    // Sorted from front_ on; the default key stands behind them.
    std::vector<EventKey> keys_ = std::vector<EventKey>(1);
    // Place of the least key; the keys before it were removed.
    std::size_t front_ = 0;
};

}  // namespace rovernet
