// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"
#include "sim/event_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {

/// Priority queue of keys whose cost per event hardly grows with their number: a lazy radix-16
/// queue.
///
/// Keys wait in four places, and top() is the earliest of the first three:
///
///   ends_     ends of frames, sorted, but for those that come before many others
///   near_     the nearest of the other keys, sorted
///   heap_     keys that came later but are due before the last key of near_
///   buckets_  all that is due later, unsorted
///
/// A key is a number of 32 hexadecimal digits: 16 of the time, 16 of what decides among equal
/// times. The bucket of a key is found by the highest digit in which it differs from a base: the
/// place of that digit is the level, its value the bucket within the level. All keys of a lower
/// level are due before those of a higher one, and on one level the digits are in order.
///
/// When near_ and heap_ are empty, the nearest buckets fill near_. A bucket that holds more than 48
/// keys is dealt out first: the digits that all its keys share become the base, which spreads them
/// over lower levels. So a key moves a few times in its life, each time to the end of a bucket, and
/// is sorted among few. Up to 64 keys need no buckets: they stay in the heap.
///
/// Keys may come in any order, also before top(). Memory follows the most keys ever pending:
/// buckets share chunks of 64 keys, and the chunks that are not full hold at most 0.5 MB.
///
/// Source: R. K. Ahuja et al., J. ACM 37(2), 1990 (the radix heap; here lazy, and not monotone).
class EventQueue {
  public:
    bool empty() const { return top_ == EventKey{}; }
    /// Number of keys, in all four places.
    std::size_t size() const { return near_.size() + heap_.size() + filed_ + ends_.size(); }
    /// Least key; the default key if the queue is empty.
    EventKey top() const { return top_; }

    /// Adds a key, which must differ from all others.
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
            // The line that it is from, without a branch that would be hard to predict.
            near_.pop_if(near_.front() == top_);
            ends_.pop_if(ends_.front() == top_);
        }
        find_top();
    }

    /// Removes every key for which keep(key) is false. It takes O(n log n) at worst; Scheduler does
    /// it when half of the keys belong to cancelled events.
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
    // Order of a key as a number without a sign, so that its digits compare.
    __extension__ using Rank = unsigned __int128;
    static constexpr Rank sign_bit = Rank{1} << 127;
    static constexpr std::size_t levels = 32;
    // Number of no chunk: the end of a chain.
    static constexpr std::uint32_t none = 0xffffffff;
    // Keys in a chunk; most_at_once of EventLine at least.
    static constexpr std::size_t chunk_size = 64;
    // Keys up to which the heap does without buckets.
    static constexpr std::size_t small = 64;

    // Keys of a bucket: a chain of chunks, all full but the one at its head.
    struct Chunk {
        std::array<EventKey, chunk_size> keys;
        std::uint32_t next = none;
    };
    // Chain of chunks, and the number of keys in it.
    struct Bucket {
        std::uint32_t chunk = none;
        std::uint32_t size = 0;
    };
    // Place of a bucket: level 0 ... 31 from the lowest digit, and the digit 0 ... 15.
    struct Place {
        std::size_t level;
        std::size_t digit;
    };

    // Rank without a sign: flipping the sign bit keeps the order.
    static Rank rank(EventKey key) { return static_cast<Rank>(key.rank()) ^ sign_bit; }
    static Time time(Rank rank) {
        return Time{Duration{static_cast<std::int64_t>((rank ^ sign_bit) >> 64)}};
    }
    // The digits above a level, and zeros below.
    static Rank above(std::size_t level, Rank rank) {
        return rank & ~((Rank{16} << 4 * level) - 1);
    }
    // Bucket of a rank, by the highest digit in which it differs from the base.
    static Place place(Rank rank, Rank base);

    // Sets top_, after filling near_ if near_ and heap_ are empty.
    void find_top() {
        if (near_.empty() && heap_.empty()) refill();
        top_ = earlier(earlier(near_.front(), ends_.front()), heap_.top());
    }
    // Puts a key into its bucket.
    void file(EventKey key);
    // Moves all keys of near_ and heap_ to the buckets and refills near_, as the heap has grown too
    // large. If that would move too many keys that are in buckets, the heap may grow to twice its
    // size.
    void spill();
    // Fills near_ from the nearest buckets, up to most_at_once keys.
    void refill();
    // Spreads the keys of a bucket over lower levels.
    void deal_out(Place place);
    // Keys in the buckets of all levels below `level`.
    std::size_t filed_below(std::size_t level) const;
    // Sets a base that is before all keys in buckets, and moves the keys whose bucket that changes.
    void lower_base(Rank base);
    // Bucket that holds the earliest keys; there must be one.
    Place nearest() const;
    // Takes the keys of a bucket out of it: the caller owns its chunks.
    Bucket take(Place place);
    // Chunk from the free ones or a new one, with `next` behind it.
    std::uint32_t add_chunk(std::uint32_t next);
    // Puts a chunk among the free ones.
    void free_chunk(std::uint32_t chunk);

    // Empties a bucket; its keys go to use(key), which may file them again.
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

    // Empties the buckets of a level, each once; their keys go to use(key).
    template <class Use>
    void refile(std::size_t level, Use use) {
        const std::uint32_t digits = used_digits_[level];
        for (std::size_t digit = 0; digit < 16; ++digit) {
            if (digits >> digit & 1) empty_bucket({level, digit}, use);
        }
    }

    EventKey top_;
    // Ends of frames, but for those that came before many others: they are with the other keys.
    EventLine ends_;
    // Other keys up to near_end_ are in near_ or in heap_, the rest in the bucket that place()
    // tells. If near_ and heap_ are empty, so are the buckets.
    EventLine near_;
    EventHeap heap_;
    // Rank up to which keys are near.
    Rank near_end_ = ~Rank{0};
    // Rank against which keys in buckets were compared; none of them is below it.
    Rank base_ = 0;
    // Size beyond which the heap is spilled.
    std::size_t heap_limit_ = small;
    // Keys in all buckets.
    std::size_t filed_ = 0;
    // A bit for each level that has a bucket with keys.
    std::uint32_t used_levels_ = 0;
    // First of the chain of chunks that no bucket uses.
    std::uint32_t free_ = none;
    // A bit for each bucket of a level that has keys.
    std::array<std::uint16_t, levels> used_digits_{};
    std::array<std::array<Bucket, 16>, levels> buckets_{};
    // Chunks of all buckets, and free ones.
    std::vector<Chunk> chunks_;
};

}  // namespace rovernet
