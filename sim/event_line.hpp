// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Keys that come nearly in order: each steps in from the back, past a few later ones at most.
class EventLine {
  public:
    bool empty() const { return size() == 0; }
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
        return true;
    }
    /// Removes front(); there must be one.
    void pop() {
        ++front_;
        if (front_ < most_gone || 2 * front_ < keys_.size()) [[likely]]
            return;
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
    }
    /// Calls visit(key) for the keys before `end`, in order, as long as it returns true. @return
    /// whether it did for all
    template <class Visit>
    bool visit_before(EventKey end, Visit visit) const {
        for (std::size_t i = front_; keys_[i] < end; ++i) {
            if (!visit(keys_[i])) return false;
        }
        return true;
    }
    /// Removes every key that `keep` refuses.
    template <class Keep>
    void filter(Keep keep) {
        keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(front_));
        front_ = 0;
        std::erase_if(keys_, [&](EventKey key) { return key != EventKey{} && !keep(key); });
    }

  private:
    static constexpr std::size_t few = 8;
    static constexpr std::size_t most_gone = 64;  // places that may always be left unused

    // In order, from front_ on, and the default key behind them.
    std::vector<EventKey> keys_ = std::vector<EventKey>(1);
    std::size_t front_ = 0;  // those before it are gone
};

}  // namespace rovernet
