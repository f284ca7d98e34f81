// SPDX-License-Identifier: MIT
#include "sim/event_heap.hpp"

namespace rovernet {

void EventHeap::push(EventKey key) {
    if (end_ == 4 * lines_.size()) lines_.emplace_back();
    sift_up(end_++, key);
}

void EventHeap::sift_up(std::size_t hole, EventKey key) {
    while (hole != root) {
        const std::size_t parent = hole / 4 + 2;
        if (!(key < at(parent))) break;
        at(hole) = at(parent);
        hole = parent;
    }
    at(hole) = key;
}

// Arithmetic, not ?:, which gcc turns into jumps that a random heap mispredicts.
std::size_t EventHeap::least_in_line(std::size_t line) const {
    const auto& keys = lines_[line].keys;
    const std::size_t low = keys[1] < keys[0];
    const std::size_t high = std::size_t{2} + (keys[3] < keys[2]);
    return 4 * line + low + (high - low) * (keys[high] < keys[low]);
}

// The hole goes down to a leaf and the last key up from there: it came from the bottom and seldom
// rises, so that the loop's length is the only branch to predict.
void EventHeap::pop() {
    const EventKey last = std::exchange(at(--end_), EventKey{});
    if (end_ == root) return;
    const std::size_t lines = (end_ + 3) / 4;
    std::size_t hole = root;
    while (hole - 2 < lines) {
        const std::size_t child = least_in_line(hole - 2);
        at(hole) = at(child);
        hole = child;
    }
    sift_up(hole, last);
}

}  // namespace rovernet
