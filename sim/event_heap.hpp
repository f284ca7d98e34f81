// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

// The key of an event, and a heap of keys. EventQueue is made of such heaps and of lines; the
// Scheduler keeps what the events are about.

namespace rovernet {

/// Order of service among events at one time.
///
/// A frame that ends at t is received before any timer of t runs, and what a user scheduled for t
/// sees all that the simulator did at t before. Keys pack the value into 4 bits.
enum class Priority : std::uint8_t {
    /// A frame ends at its receivers.
    frame_end,
    /// Timer of a protocol or an access model, end of a leg, change of links, end of a frame's
    /// wait.
    timer,
    /// Start of a frame; no part schedules it today.
    frame_start,
    /// Action of a user, or a reaction to a message, an arrival or a lost link.
    user
};

/// Place of an event in the order of service: time, then priority, then sequence (first scheduled,
/// first served). This order is total, so that a run does not depend on how a queue is built.
///
/// A key has 16 bytes: the time [ns], and 4 bits priority | 36 bits sequence | 24 bits slot. The
/// slot is where the Scheduler keeps the event's payload; it takes no part in the order.
class EventKey {
  public:
    /// Key after every event: what a queue answers that has none.
    constexpr EventKey() = default;
    /// @param t         when the event is served
    /// @param priority  order among events at `t`
    /// @param sequence  number of the event, < 2^36; no two events of a run share one
    /// @param slot      where its payload is, < 2^24
    constexpr EventKey(Time t, Priority priority, std::uint64_t sequence, std::uint32_t slot)
        : time_(t.time_since_epoch().count()),
          word_(std::uint64_t{static_cast<std::uint8_t>(priority)} << 60 | sequence << 24 | slot) {}

    /// Parts of the key, as they were given.
    constexpr Time time() const { return Time{Duration{time_}}; }
    constexpr Priority priority() const { return static_cast<Priority>(word_ >> 60); }
    constexpr std::uint64_t sequence() const { return word_ << 4 >> 28; }
    constexpr std::uint32_t slot() const { return word_ & 0xffffff; }

    /// Key of the same priority, sequence and slot at another time.
    constexpr EventKey at(Time t) const { return {t, priority(), sequence(), slot()}; }

    /// Order of service, as one comparison of 128 bits without a branch: which of two keys is
    /// earlier can seldom be predicted. Sequences differ, so that the slot never decides.
    friend constexpr bool operator<(EventKey a, EventKey b) { return a.rank() < b.rank(); }
    friend constexpr bool operator==(EventKey, EventKey) = default;
    /// Earlier of two keys. Unlike std::min, whose references gcc turns into jumps, it takes no
    /// branch.
    friend constexpr EventKey earlier(EventKey a, EventKey b) { return b < a ? b : a; }

    /// Order as a number: the time in the upper 64 bits, priority, sequence and slot below.
    __extension__ using Int128 = __int128;
    constexpr Int128 rank() const { return (Int128{time_} << 64) | word_; }

  private:
    // Time [ns], and priority, sequence and slot in one word.
    std::int64_t time_ = std::numeric_limits<std::int64_t>::max();
    std::uint64_t word_ = ~std::uint64_t{0};
};

/// Allocator whose memory begins with a cache line (64 bytes), which four keys fill.
template <class T>
struct LineAllocator {
    using value_type = T;
    /// Alignment [bytes].
    static constexpr std::align_val_t line{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
    void deallocate(T* values, std::size_t) { ::operator delete(values, line); }
    friend bool operator==(LineAllocator, LineAllocator) { return true; }
};

/// Priority queue of keys: a heap with four children to a node (4-ary). A push compares the key
/// with log4(n) others at most, a pop with about 3 log4(n).
///
/// The four children of a node lie in one cache line, and the least of them is found without a
/// branch: half the levels of a binary heap. EventQueue uses it for the few keys that come too late
/// for its lines, and for all but the ends of frames while few events are pending.
///
/// Keys must differ.
class EventHeap {
  public:
    /// Whether there is no key.
    bool empty() const { return end_ == root; }
    /// Number of keys.
    std::size_t size() const { return end_ - root; }
    /// Least key; the default key if the heap is empty.
    EventKey top() const { return keys_[root]; }

    /// Adds a key. Amortised allocation, as of a std::vector.
    void push(EventKey key);
    /// Removes top(); the heap must not be empty.
    void pop();
    /// Removes every key for which keep(key) is false. It takes O(n log n) at worst.
    template <class Keep>
    void filter(Keep keep) {
        const std::size_t old_end = std::exchange(end_, root);
        for (std::size_t i = root; i < old_end; ++i) {
            const EventKey key = std::exchange(keys_[i], EventKey{});
            if (keep(key)) push(key);
        }
    }

  private:
    // The root is 3, so that the children of i fill the line of four that begins at 4 (i - 2).
    // Places from end_ on hold the default key, so that a line can always be searched whole.
    static constexpr std::size_t root = 3;
    // Keys in a cache line.
    static constexpr std::size_t line = 4;
    using Keys = std::vector<EventKey, LineAllocator<EventKey>>;

    // Moves the hole towards the root until `key` fits in.
    void sift_up(std::size_t hole, EventKey key);

    // Keys by place; the first places are never used.
    Keys keys_ = Keys(line);
    // Place behind the last key.
    std::size_t end_ = root;
};

}  // namespace rovernet
