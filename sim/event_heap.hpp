// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace rovernet {

/// Order of service among events at one time.
enum class Priority : std::uint8_t { frame_end, timer, frame_start, user };

/// An event's place in the order of service: time, then priority, then sequence (first scheduled,
/// first served). 16 bytes: the time [ns], and 4 bits priority | 36 bits sequence | 24 bits slot.
class EventKey {
  public:
    constexpr EventKey() = default;  ///< after every event
    constexpr EventKey(Time t, Priority priority, std::uint64_t sequence, std::uint32_t slot)
        : time_(t.time_since_epoch().count()),
          word_(std::uint64_t{static_cast<std::uint8_t>(priority)} << 60 | sequence << 24 | slot) {}

    constexpr Time time() const { return Time{Duration{time_}}; }
    constexpr Priority priority() const { return static_cast<Priority>(word_ >> 60); }
    constexpr std::uint64_t sequence() const { return word_ << 4 >> 28; }
    constexpr std::uint32_t slot() const { return word_ & 0xffffff; }

    /// The same priority and sequence at another time.
    constexpr EventKey at(Time t) const { return {t, priority(), sequence(), slot()}; }

    /// One comparison of 128 bits, without a branch. Sequences differ: the slot never decides.
    friend constexpr bool operator<(EventKey a, EventKey b) { return a.rank() < b.rank(); }
    friend constexpr bool operator==(EventKey, EventKey) = default;
    /// Unlike std::min, whose references gcc turns into jumps, it takes no branch.
    friend constexpr EventKey earlier(EventKey a, EventKey b) { return b < a ? b : a; }

    /// The order as a number: the time above, what decides among equal times below.
    __extension__ using Int128 = __int128;
    constexpr Int128 rank() const { return (Int128{time_} << 64) | word_; }

  private:
    std::int64_t time_ = std::numeric_limits<std::int64_t>::max();
    std::uint64_t word_ = ~std::uint64_t{0};
};

/// Allocates what begins with a cache line.
template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t line{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
    void deallocate(T* values, std::size_t) { ::operator delete(values, line); }
    friend bool operator==(LineAllocator, LineAllocator) { return true; }
};

/// A 4-ary heap of keys: siblings share a cache line, and the least is chosen without a branch.
class EventHeap {
  public:
    bool empty() const { return end_ == root; }
    std::size_t size() const { return end_ - root; }
    /// The least key; if there is none, the default key.
    EventKey top() const { return keys_[root]; }

    void push(EventKey key);
    /// Removes top(); there must be one.
    void pop();
    /// Removes every key that `keep` refuses.
    template <class Keep>
    void filter(Keep keep) {
        const std::size_t old_end = std::exchange(end_, root);
        for (std::size_t i = root; i < old_end; ++i) {
            const EventKey key = std::exchange(keys_[i], EventKey{});
            if (keep(key)) push(key);
        }
    }

  private:
    // The root is 3; the children of i fill the line of four that begins at 4 (i - 2). Places from
    // end_ on hold the default key, so that a line can always be searched whole.
    static constexpr std::size_t root = 3;
    static constexpr std::size_t line = 4;
    using Keys = std::vector<EventKey, LineAllocator<EventKey>>;

    void sift_up(std::size_t hole, EventKey key);

    Keys keys_ = Keys(line);
    std::size_t end_ = root;
};

}  // namespace rovernet
