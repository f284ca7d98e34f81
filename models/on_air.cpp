// SPDX-License-Identifier: MIT
#include "models/on_air.hpp"

#include <utility>

namespace rovernet {

void OnAir::add(NodeId node, const Arrival& arrival, Time since) {
    if (node.index() >= last_.size()) last_.resize(node.index() + 1, none);
    std::uint32_t& last = last_[node.index()];
    while (last != none && entries_[entries_[last].next].arrival.end <= since) {
        forget_next(last, last);
    }
    std::uint32_t place = free_;
    if (place == none) {
        place = static_cast<std::uint32_t>(entries_.size());
        entries_.emplace_back();
    } else {
        free_ = entries_[place].next;
    }
    entries_[place] = {arrival, place};
    if (last != none) std::swap(entries_[place].next, entries_[last].next);
    last = place;
}

void OnAir::forget_next(std::uint32_t before, std::uint32_t& last) {
    const std::uint32_t place = entries_[before].next;
    entries_[before].next = entries_[place].next;
    entries_[place].next = free_;
    free_ = place;
    if (place == last) last = place == before ? none : before;
}

}  // namespace rovernet
