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

/// A queue of keys whose cost per event hardly grows with their number: a lazy radix-16 queue.
///
/// The nearest keys stand in a line, the others lie unsorted in buckets: a key's level is that of
/// the highest of its 32 hexadecimal digits (16 of the time, 16 of what decides among equal times)
/// in which it differs from a base, and its bucket there is the digit. When the line is used up,
/// the nearest buckets fill it; one that holds too much is first dealt out to lower levels. So a
/// key moves a few times, always to the end of a bucket, and is sorted among a few. A heap takes
/// what comes later, but before the last of the line. A small queue is the heap alone.
///
/// Frames last about equally long, so that their ends come nearly in order: they stand in a line of
/// their own, but for those that come before many.
///
/// Keys may come in any order, also before top(). Memory follows the most keys ever pending:
/// buckets share chunks of 64 keys, of which those not full hold at most 0.5 MB.
///
/// Source: R. K. Ahuja et al., J. ACM 37(2), 1990 (the radix heap; here lazy, and not monotone).
class EventQueue {
  public:
    bool empty() const { return top_ == EventKey{}; }
    std::size_t size() const { return near_.size() + heap_.size() + filed_ + ends_.size(); }
    /// The least key; if there is none, the default key.
    EventKey top() const { return top_; }

    void push(EventKey key) {
        top_ = earlier(top_, key);
        if (key.priority() == Priority::frame_end && ends_.push(key)) return;
        if (rank(key) > near_end_) return file(key);
        heap_.push(key);
        if (heap_.size() > heap_limit_) spill();
    }

    /// Removes top(); there must be one.
    void pop() {
        if (heap_.top() == top_) {
            heap_.pop();
        } else {
            // Whichever it is, without a branch that would be hard to predict.
            near_.pop_if(near_.front() == top_);
            ends_.pop_if(ends_.front() == top_);
        }
        find_top();
    }

    /// Removes every key that `keep` refuses.
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
    __extension__ using Rank = unsigned __int128;
    static constexpr Rank sign_bit = Rank{1} << 127;
    static constexpr std::size_t levels = 32;
    static constexpr std::uint32_t none = 0xffffffff;
    static constexpr std::size_t chunk_size = 64;
    static constexpr std::size_t small = 64;  // keys that need no buckets

    // The keys of a bucket are a chain of chunks: full ones, and at its head one that may not be.
    struct Chunk {
        std::array<EventKey, chunk_size> keys;
        std::uint32_t next = none;
    };
    struct Bucket {
        std::uint32_t chunk = none;
        std::uint32_t size = 0;
    };
    struct Place {
        std::size_t level;
        std::size_t digit;
    };

    // As unsigned: flipping the sign bit keeps the order.
    static Rank rank(EventKey key) { return static_cast<Rank>(key.rank()) ^ sign_bit; }
    static Time time(Rank rank) {
        return Time{Duration{static_cast<std::int64_t>((rank ^ sign_bit) >> 64)}};
    }
    // The digits above a level, and zeros.
    static Rank above(std::size_t level, Rank rank) {
        return rank & ~((Rank{16} << 4 * level) - 1);
    }
    static Place place(Rank rank, Rank base);

    void find_top() {
        if (near_.empty() && heap_.empty()) refill();
        top_ = earlier(earlier(near_.front(), ends_.front()), heap_.top());
    }
    void file(EventKey key);
    void spill();
    void refill();
    void deal_out(Place place);
    std::size_t filed_below(std::size_t level) const;
    void lower_base(Rank base);
    Place nearest() const;
    Bucket take(Place place);
    std::uint32_t add_chunk(std::uint32_t next);
    void free_chunk(std::uint32_t chunk);

    // Empties a bucket; its keys go to `use`, which may file them again.
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

    // Empties the buckets of a level, each once.
    template <class Use>
    void refile(std::size_t level, Use use) {
        const std::uint32_t digits = used_digits_[level];
        for (std::size_t digit = 0; digit < 16; ++digit) {
            if (digits >> digit & 1) empty_bucket({level, digit}, use);
        }
    }

    EventKey top_;
    EventLine ends_;  // of frames
    // Of the other keys, all up to near_end_ are in near_ or the heap, the rest in the buckets that
    // place() tells. If both are empty, so are the buckets.
    EventLine near_;
    EventHeap heap_;
    Rank near_end_ = ~Rank{0};
    Rank base_ = 0;
    std::size_t heap_limit_ = small;
    std::size_t filed_ = 0;  // keys in buckets
    std::uint32_t used_levels_ = 0;
    std::uint32_t free_ = none;
    std::array<std::uint16_t, levels> used_digits_{};
    std::array<std::array<Bucket, 16>, levels> buckets_{};
    std::vector<Chunk> chunks_;
};

}  // namespace rovernet
