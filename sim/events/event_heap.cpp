// SPDX-License-Identifier: MIT
#include "sim/events/event_heap.hpp"

namespace rovernet {
namespace {

/// Index of the least of four keys, computed arithmetically; gcc compiles ?: to jumps, which a
/// random heap mispredicts.
std::size_t least_of_four(const EventKey* keys) {
    const std::size_t low = keys[1] < keys[0];
    const std::size_t high = std::size_t{2} + (keys[3] < keys[2]);
    return low + (high - low) * (keys[high] < keys[low]);
}

}  // namespace

void EventHeap::push(EventKey key) {
    if (end_ == keys_.size()) keys_.resize(end_ + line);
    sift_up(end_++, key);
}

void EventHeap::sift_up(std::size_t hole, EventKey key) {
    EventKey* const keys = keys_.data();
    while (hole != root) {
        const std::size_t parent = hole / 4 + 2;
        if (!(key < keys[parent])) break;
        keys[hole] = keys[parent];
        hole = parent;
    }
    keys[hole] = key;
}

// The hole moves down to a leaf, then the last key up from there: that key came from the bottom and
// seldom rises, so the loop's length is the only branch to predict.
void EventHeap::pop() {
    EventKey* const keys = keys_.data();
    const EventKey last = std::exchange(keys[--end_], EventKey{});
    if (end_ == root) return;
    std::size_t hole = root;
    for (std::size_t first = line; first < end_; first = line * (hole - 2)) {
        const std::size_t child = first + least_of_four(keys + first);
        keys[hole] = keys[child];
        hole = child;
    }
    sift_up(hole, last);
}

}  // namespace rovernet
