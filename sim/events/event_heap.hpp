// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

// Key of an event, and a heap of keys. EventQueue consists of such heaps and of lines; the
// Scheduler stores the payloads of the events.

namespace rovernet {

/// Order of service among events at the same time.
///
/// A frame that ends at t is received before any timer of t runs; an action that a user scheduled
/// for t runs after all simulator events of t. EventKey packs the value into 4 bits.
enum class Priority : std::uint8_t {
    /// End of a frame at its receivers.
    frame_end,
    /// Timer of a protocol or an access model, end of a leg, link change, or time to send a waiting
    /// frame.
    timer,
    /// Start of a frame; no event has this priority.
    frame_start,
    /// Action of a user, or a reaction to a message, an arrival or a lost link.
    user
};

/// Position of an event in the order of service: by time, then priority, then sequence (first
/// scheduled, first served). No two events are equal, so a run does not depend on the queue's
/// structure.
///
/// A key has 16 bytes: the time [ns], and 4 bits priority | 36 bits sequence | 24 bits slot. The
/// slot is the index of the event's payload in the Scheduler, and does not affect the order.
class EventKey {
  public:
    /// Default key, later than the key of every event; the top of an empty queue.
    constexpr EventKey() = default;
    /// @param t         time at which the event is served
    /// @param priority  order among events at `t`
    /// @param sequence  number of the event, < 2^36; no two events of a run share one
    /// @param slot      index of the event's payload, < 2^24
    constexpr EventKey(Time t, Priority priority, std::uint64_t sequence, std::uint32_t slot)
        : time_(t.time_since_epoch().count()),
          word_(std::uint64_t{static_cast<std::uint8_t>(priority)} << 60 | sequence << 24 | slot) {}

    /// Parts of the key, as passed to the constructor: time, priority, sequence and slot.
    constexpr Time time() const { return Time{Duration{time_}}; }
    constexpr Priority priority() const { return static_cast<Priority>(word_ >> 60); }
    constexpr std::uint64_t sequence() const { return word_ << 4 >> 28; }
    constexpr std::uint32_t slot() const { return word_ & 0xffffff; }

    /// Key with the same priority, sequence and slot at another time.
    constexpr EventKey at(Time t) const { return {t, priority(), sequence(), slot()}; }

    /// Order of service: by time, then priority, then sequence. One comparison of 128 bits avoids
    /// branches, which the processor would predict badly. No two events have equal sequence
    /// numbers, so the payload slot in the lowest bits does not affect the order.
    friend constexpr bool operator<(EventKey a, EventKey b) { return a.rank() < b.rank(); }
    friend constexpr bool operator==(EventKey, EventKey) = default;
    /// Earlier of two keys, without a branch (gcc compiles the references of std::min to jumps).
    friend constexpr EventKey earlier(EventKey a, EventKey b) { return b < a ? b : a; }

    /// Order as a number: the time in the upper 64 bits, priority, sequence and slot below.
    __extension__ using Int128 = __int128;
    constexpr Int128 rank() const { return (Int128{time_} << 64) | word_; }

  private:
    // Time [ns]; the word below packs priority, sequence and slot.
    std::int64_t time_ = std::numeric_limits<std::int64_t>::max();
    std::uint64_t word_ = ~std::uint64_t{0};
};

/// Allocator whose memory is aligned to cache lines (64 bytes); a cache line contains four keys.
template <class T>
struct LineAllocator {
    using value_type = T;
    /// Alignment of the memory [bytes].
    static constexpr std::align_val_t line{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
    void deallocate(T* values, std::size_t) { ::operator delete(values, line); }
    friend bool operator==(LineAllocator, LineAllocator) { return true; }
};

/// Priority queue of keys: a 4-ary heap, in which every node has up to four children. A push
/// compares the key with at most log4(n) keys, a pop with about 3 log4(n).
///
/// The four children of a node lie in one cache line, and the smallest of the four is found without
/// a branch; there are half as many levels as in a binary heap. EventQueue uses an EventHeap for
/// the few keys that are too late for its sorted lines, and for all keys but ends of frames while
/// few events are pending.
///
/// All keys in a heap must differ.
class EventHeap {
  public:
    /// Whether the heap has no key.
    bool empty() const { return end_ == root; }
    /// Number of keys in the heap.
    std::size_t size() const { return end_ - root; }
    /// Smallest key: key of the earliest event; the default key if the heap is empty.
    EventKey top() const { return keys_[root]; }

    /// Adds a key. Memory grows by doubling, as in a std::vector.
    void push(EventKey key);
    /// Removes top(); the heap must not be empty.
    void pop();
    /// Removes every key for which keep(key) is false, in a time O(n log n) at worst.
    template <class Keep>
    void filter(Keep keep) {
        const std::size_t old_end = std::exchange(end_, root);
        for (std::size_t i = root; i < old_end; ++i) {
            const EventKey key = std::exchange(keys_[i], EventKey{});
            if (keep(key)) push(key);
        }
    }

  private:
    // Index of the root: 3, so that the children of i fill the four-key line from 4 (i - 2) on.
    // Entries from end_ on contain the default key, so that a whole line can always be searched.
    static constexpr std::size_t root = 3;
    // Number of keys in a cache line.
    static constexpr std::size_t line = 4;
    using Keys = std::vector<EventKey, LineAllocator<EventKey>>;

    // Moves the empty place `hole` towards the root until `key` can be stored in it.
    void sift_up(std::size_t hole, EventKey key);

    // Keys by index; the entries before the root are not used.
    Keys keys_ = Keys(line);
    // Index behind the last key.
    std::size_t end_ = root;
};

}  // namespace rovernet
