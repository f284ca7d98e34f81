// SPDX-License-Identifier: MIT
#include "sim/events/event_queue.hpp"

#include <bit>
#include <utility>

namespace rovernet {

EventQueue::Place EventQueue::place(Rank rank, Rank base) {
    const Rank differing = rank ^ base;
    const auto high = static_cast<std::uint64_t>(differing >> 64);
    if (high != 0) {
        const auto level = static_cast<std::size_t>(63 - std::countl_zero(high)) / 4;
        return {16 + level, static_cast<std::uint64_t>(rank >> 64) >> 4 * level & 15};
    }
    // The base itself belongs to the lowest level.
    const auto low = static_cast<std::uint64_t>(differing) | 1;
    const auto level = static_cast<std::size_t>(63 - std::countl_zero(low)) / 4;
    return {level, static_cast<std::uint64_t>(rank) >> 4 * level & 15};
}

void EventQueue::file(EventKey key) {
    const auto [level, digit] = place(rank(key), base_);
    Bucket& bucket = buckets_[level][digit];
    const std::size_t i = bucket.size % chunk_size;
    if (i == 0) {
        bucket.chunk = add_chunk(bucket.chunk);
        used_levels_ |= 1U << level;
        used_digits_[level] = static_cast<std::uint16_t>(used_digits_[level] | 1U << digit);
    }
    chunks_[bucket.chunk].keys[i] = key;
    ++bucket.size;
    ++filed_;
}

// Keys below the base can only be spilled if the base is lowered, which moves the keys in nearby
// buckets. If these are many, the spill waits until as many keys were added; the heap may grow
// meanwhile.
void EventQueue::spill() {
    for (; !near_.empty(); near_.pop_if(true)) heap_.push(near_.front());
    const Rank least = rank(heap_.top());
    if (least < base_) {
        if (filed_below(place(least, base_).level) > 4 * heap_.size()) {
            heap_limit_ = 2 * heap_.size();
            return;
        }
        lower_base(least);
    }
    base_ = least;
    heap_.filter([this](EventKey key) {
        file(key);
        return false;
    });
    refill();
}

std::size_t EventQueue::filed_below(std::size_t level) const {
    std::size_t keys = 0;
    for (std::size_t below = 0; below < level; ++below) {
        for (const Bucket& bucket : buckets_[below]) keys += bucket.size;
    }
    return keys;
}

// Keys of levels from `end` on stay in their buckets: their highest different digit is the same for
// both bases.
void EventQueue::lower_base(Rank base) {
    const std::size_t end = place(base, base_).level;
    base_ = base;
    for (std::size_t level = 0; level < end; ++level) {
        refile(level, [this](EventKey key) { file(key); });
    }
}

void EventQueue::refill() {
    heap_limit_ = small;
    while (filed_ > 0) {
        const Place next = nearest();
        const std::size_t size = buckets_[next.level][next.digit].size;
        if (near_.size() + size > EventLine::most_at_once) {
            if (!near_.empty()) return;
            deal_out(next);
            continue;
        }
        static_assert(EventLine::most_at_once <= chunk_size);
        const std::uint32_t chunk = take(next).chunk;
        const Rank unit = Rank{1} << 4 * next.level;
        const int bits = std::max(4 * static_cast<int>(next.level) - 64, 0);  // of times
        const Rank first = above(next.level, base_) | next.digit * unit;
        near_.append({chunks_[chunk].keys.data(), size}, time(first), bits);
        free_chunk(chunk);
        near_end_ = first | (unit - 1);
    }
    near_end_ = ~Rank{0};
}

// The new base has all digits that the keys of the bucket share: the keys move down by that many
// levels at once.
void EventQueue::deal_out(Place from) {
    const Bucket& bucket = buckets_[from.level][from.digit];
    const Rank any = rank(chunks_[bucket.chunk].keys[0]);
    Rank differing = 0;
    std::size_t n = (bucket.size - 1) % chunk_size + 1;
    for (std::uint32_t i = bucket.chunk; i != none; i = chunks_[i].next, n = chunk_size) {
        const auto& keys = chunks_[i].keys;
        for (std::size_t k = 0; k < n; ++k) differing |= rank(keys[k]) ^ any;
    }
    base_ = above(place(differing, 0).level, any);
    empty_bucket(from, [this](EventKey key) { file(key); });
}

EventQueue::Place EventQueue::nearest() const {
    const auto level = static_cast<std::size_t>(std::countr_zero(used_levels_));
    return {level, static_cast<std::size_t>(std::countr_zero(used_digits_[level]))};
}

EventQueue::Bucket EventQueue::take(Place place) {
    const auto [level, digit] = place;
    const Bucket bucket = std::exchange(buckets_[level][digit], {});
    filed_ -= bucket.size;
    used_digits_[level] = static_cast<std::uint16_t>(used_digits_[level] & ~(1U << digit));
    if (used_digits_[level] == 0) used_levels_ &= ~(1U << level);
    return bucket;
}

std::uint32_t EventQueue::add_chunk(std::uint32_t next) {
    if (free_ == none) {
        free_ = static_cast<std::uint32_t>(chunks_.size());
        chunks_.emplace_back();
    }
    const std::uint32_t chunk = free_;
    free_ = std::exchange(chunks_[chunk].next, next);
    return chunk;
}

void EventQueue::free_chunk(std::uint32_t chunk) {
    chunks_[chunk].next = std::exchange(free_, chunk);
}

}  // namespace rovernet
