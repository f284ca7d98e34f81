// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

/// Keys in order. They come nearly in order, each stepping in from the back past a few later ones
/// at most, or in groups, each later than all before.
class EventLine {
  public:
    static constexpr std::size_t most_at_once = 48;  ///< keys of a group

    bool empty() const { return front() == EventKey{}; }
    std::size_t size() const { return keys_.size() - 1 - front_; }
    /// The least key; if there is none, the default key.
    EventKey front() const { return keys_[front_]; }

    /// Adds a key, unless it comes before more than a few. @return whether it did
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
    /// Adds keys that come after all others. @param first not after their times, which differ from
    /// it by less than 2^bits ns
    void append(std::span<const EventKey> group, Time first, int bits);
    /// Removes front(), if `remove`; there must be one then.
    void pop_if(bool remove) { front_ += remove; }
    /// Removes every key that `keep` refuses.
    template <class Keep>
    void filter(Keep keep) {
        forget_gone();
        std::erase_if(keys_, [&](EventKey key) { return key != EventKey{} && !keep(key); });
    }

  private:
    static constexpr std::size_t few = 8;
    static constexpr std::size_t most_gone = 64;  // places that may always be left unused

    void forget_gone() {
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
    }

    // In order, from front_ on, and the default key behind them.
    std::vector<EventKey> keys_ = std::vector<EventKey>(1);
    std::size_t front_ = 0;  // those before it are gone
};

}  // namespace rovernet
