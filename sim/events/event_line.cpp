// SPDX-License-Identifier: MIT
#include "sim/events/event_line.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rovernet {
namespace {

// Times are first compared by their upper bits, as 32-bit numbers, so that the compiler compares
// several at once. The index in the group is in the lower bits: no two numbers are equal.
constexpr int place_bits = 6;
constexpr int time_bits = 31 - place_bits;
static_assert(EventLine::most_at_once <= 1U << place_bits);

/// Sorts keys that are nearly in order.
void insertion_sort(std::span<EventKey> keys) {
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i - 1] < keys[i]) [[likely]]
            continue;
        const EventKey key = keys[i];
        std::size_t place = i;
        for (; place > 0 && key < keys[place - 1]; --place) keys[place] = keys[place - 1];
        keys[place] = key;
    }
}

}  // namespace

// The position of a key is the number of earlier keys, counted without a branch. Keys with equal
// upper bits may still be in the wrong order; a final insertion sort corrects it.
void EventLine::append(std::span<const EventKey> group, Time first, int bits) {
    const std::size_t n = group.size();
    const int dropped = std::max(bits - time_bits, 0);
    std::array<std::int32_t, most_at_once> times;
    for (std::size_t i = 0; i < n; ++i) {
        const std::int64_t time = (group[i].time() - first).count() >> dropped;
        times[i] = static_cast<std::int32_t>(time << place_bits | static_cast<std::int64_t>(i));
    }
    forget_gone();
    const std::size_t end = keys_.size() - 1;
    keys_.resize(end + n + 1);
    EventKey* const added = keys_.data() + end;
    for (std::size_t i = 0; i < n; ++i) {
        std::int32_t earlier = 0;
        for (std::size_t k = 0; k < n; ++k) earlier += times[k] < times[i];
        added[earlier] = group[i];
    }
    insertion_sort({added, n});
}

}  // namespace rovernet
