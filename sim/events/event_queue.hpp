// SPDX-License-Identifier: MIT
#pragma once

#include "sim/events/event_heap.hpp"
#include "sim/events/event_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {

/// Priority queue of event keys: a lazy radix-16 queue. The cost per event hardly grows with the
/// number of keys.
///
/// Keys are stored in four places; top() is the earliest key of the first three:
///
///   ends_     ends of frames, sorted, except those that precede many stored ends
///   near_     the earliest of the other keys, sorted
///   heap_     keys that were added later but are due before the last key of near_
///   buckets_  all later keys, unsorted
///
/// A key is a number of 32 hexadecimal digits: 16 digits of time, and 16 digits that order equal
/// times. The bucket of a key depends on the highest digit in which the key differs from a base:
/// the position of that digit is the level, its value is the bucket within the level. All keys of a
/// lower level are due before all keys of a higher level; on one level the digits are in order.
///
/// When near_ and heap_ are empty, the earliest buckets fill near_. A bucket with more than 48 keys
/// is first spread over lower levels: the digits that all its keys share become the base. Thus a
/// key moves only a few times, each time to the end of a bucket, and is sorted among few keys. Up
/// to 64 keys stay in the heap, without buckets.
///
/// Keys may be added in any order, also before top(). Memory follows the largest number of pending
/// keys: buckets share chunks of 64 keys, and chunks that are not full take at most 0.5 MB.
///
/// Source: R. K. Ahuja et al., J. ACM 37(2), 1990 (the radix heap; lazy and not monotone here).
class EventQueue {
  public:
    bool empty() const { return top_ == EventKey{}; }
    /// Number of keys in the queue.
    std::size_t size() const { return near_.size() + heap_.size() + filed_ + ends_.size(); }
    /// Smallest key: key of the earliest event; the default key if the queue is empty.
    EventKey top() const { return top_; }

    /// Adds a key, which must differ from all stored keys.
    void push(EventKey key) {
        top_ = earlier(top_, key);
        if (key.priority() == Priority::frame_end && ends_.push(key)) return;
        if (rank(key) > near_end_) return file(key);
        heap_.push(key);
        if (heap_.size() > heap_limit_) spill();
    }

    /// Removes top(); the queue must not be empty.
    void pop() {
        if (heap_.top() == top_) {
            heap_.pop();
        } else {
            // Pop the line that top_ is from, without a branch, which would be hard to predict.
            near_.pop_if(near_.front() == top_);
            ends_.pop_if(ends_.front() == top_);
        }
        find_top();
    }

    /// Removes every key for which keep(key) is false, in a time O(n log n) at worst. Scheduler
    /// calls filter() when half of the keys belong to cancelled events.
    template <class Keep>
    void filter(Keep keep) {
        near_.filter(keep);
        ends_.filter(keep);
        heap_.filter(keep);
        for (std::size_t level = 0; level < levels; ++level) {
            refile(level, [&](EventKey key) {
                if (keep(key)) file(key);
            });
        }
        find_top();
    }

  private:
    // Order of a key as an unsigned number, whose digits can be compared.
    __extension__ using Rank = unsigned __int128;
    static constexpr Rank sign_bit = Rank{1} << 127;
    static constexpr std::size_t levels = 32;
    // Chunk number that marks the end of a chain.
    static constexpr std::uint32_t none = 0xffffffff;
    // Number of keys in a chunk; at least EventLine::most_at_once.
    static constexpr std::size_t chunk_size = 64;
    // Number of keys up to which all keys stay in the heap.
    static constexpr std::size_t small = 64;

    // Chunk of a bucket's keys; chunks form a chain, and all but the first are full.
    struct Chunk {
        std::array<EventKey, chunk_size> keys;
        std::uint32_t next = none;
    };
    // Chain of chunks, and total number of keys in these chunks.
    struct Bucket {
        std::uint32_t chunk = none;
        std::uint32_t size = 0;
    };
    // Place of a bucket: level 0 ... 31, counted from the lowest digit, and digit 0 ... 15.
    struct Place {
        std::size_t level;
        std::size_t digit;
    };

    // Unsigned rank of a key: flipping the sign bit preserves the order.
    static Rank rank(EventKey key) { return static_cast<Rank>(key.rank()) ^ sign_bit; }
    static Time time(Rank rank) {
        return Time{Duration{static_cast<std::int64_t>((rank ^ sign_bit) >> 64)}};
    }
    // Rank in which the digit of a level and all lower digits are replaced by 0.
    static Rank above(std::size_t level, Rank rank) {
        return rank & ~((Rank{16} << 4 * level) - 1);
    }
    // Bucket of a rank, by the highest digit in which the rank differs from the base.
    static Place place(Rank rank, Rank base);

    // Sets top_, after filling near_ if near_ and heap_ are empty.
    void find_top() {
        if (near_.empty() && heap_.empty()) refill();
        top_ = earlier(earlier(near_.front(), ends_.front()), heap_.top());
    }
    // Puts a key into its bucket.
    void file(EventKey key);
    // Moves all keys of near_ and heap_ to the buckets and refills near_, because the heap is too
    // large. If too many keys in buckets would have to move, the heap may grow to twice its size
    // instead.
    void spill();
    // Fills near_ from the earliest buckets, up to most_at_once keys.
    void refill();
    // Spreads the keys of a bucket over lower levels.
    void deal_out(Place place);
    // Number of keys in the buckets of all levels below `level`.
    std::size_t filed_below(std::size_t level) const;
    // Replaces base_ by a lower rank, and moves the keys whose bucket changes.
    void lower_base(Rank base);
    // Bucket with the earliest keys; at least one bucket must have keys.
    Place nearest() const;
    // Empties a bucket and returns its keys; the caller then owns their chunks.
    Bucket take(Place place);
    // Returns a free or new chunk, with `next` behind it in the chain.
    std::uint32_t add_chunk(std::uint32_t next);
    // Adds a chunk to the free chunks.
    void free_chunk(std::uint32_t chunk);

    // Empties a bucket and calls use(key) for each of its keys; use() may file the key again.
    template <class Use>
    void empty_bucket(Place place, Use use) {
        Bucket bucket = take(place);
        while (bucket.size > 0) {
            const std::uint32_t n = (bucket.size - 1) % chunk_size + 1;
            for (std::uint32_t i = 0; i < n; ++i) use(chunks_[bucket.chunk].keys[i]);
            const std::uint32_t next = chunks_[bucket.chunk].next;
            free_chunk(bucket.chunk);
            bucket = {next, bucket.size - n};
        }
    }

    // Empties all buckets of a level once and calls use(key) for their keys.
    template <class Use>
    void refile(std::size_t level, Use use) {
        const std::uint32_t digits = used_digits_[level];
        for (std::size_t digit = 0; digit < 16; ++digit) {
            if (digits >> digit & 1) empty_bucket({level, digit}, use);
        }
    }

    EventKey top_;
    // Ends of frames, except those that precede many stored ends, which are among the other keys.
    EventLine ends_;
    // Other keys: keys up to near_end_ are in near_ or heap_, later keys in the bucket given by
    // place(). If near_ and heap_ are empty, all buckets are empty.
    EventLine near_;
    EventHeap heap_;
    // Largest rank of the keys in near_ and heap_.
    Rank near_end_ = ~Rank{0};
    // Base: rank that determines the bucket of each key, by the highest digit in which rank and
    // base differ. No key in a bucket has a rank below the base.
    Rank base_ = 0;
    // Size of the heap beyond which spill() is called.
    std::size_t heap_limit_ = small;
    // Number of keys in all buckets.
    std::size_t filed_ = 0;
    // Bit mask of the levels that have keys.
    std::uint32_t used_levels_ = 0;
    // Index in chunks_ of the first free chunk; free chunks form a chain by Chunk::next.
    std::uint32_t free_ = none;
    // Bit mask of the non-empty buckets, for each level.
    std::array<std::uint16_t, levels> used_digits_{};
    std::array<std::array<Bucket, 16>, levels> buckets_{};
    // Chunks of all buckets, and free chunks.
    std::vector<Chunk> chunks_;
};

}  // namespace rovernet
