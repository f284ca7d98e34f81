// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Keys that come nearly in order: each steps in from the back, past a few later ones at most.
class EventLine {
  public:
    bool empty() const { return front_ == keys_.size(); }
    std::size_t size() const { return keys_.size() - front_; }
    /// The least key; if there is none, the default key.
    EventKey front() const { return empty() ? EventKey{} : keys_[front_]; }

    /// Adds a key, unless it comes before more than a few. @return whether it did
    bool push(EventKey key) {
        std::size_t place = keys_.size();
        const std::size_t first = size() > few ? place - few : front_;
        while (place > first && key < keys_[place - 1]) --place;
        if (place == first && place > front_ && key < keys_[place - 1]) return false;
        keys_.insert(keys_.begin() + static_cast<std::ptrdiff_t>(place), key);
        return true;
    }
    /// Removes front(); there must be one.
    void pop() {
        ++front_;
        if (2 * front_ < keys_.size()) return;
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
    }
    /// Removes every key that `keep` refuses.
    template <class Keep>
    void filter(Keep keep) {
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
        std::erase_if(keys_, [&](EventKey key) { return !keep(key); });
    }

  private:
    static constexpr std::size_t few = 8;

    std::vector<EventKey> keys_;  // in order, from front_ on
    std::size_t front_ = 0;       // those before it are gone
};

}  // namespace rovernet
