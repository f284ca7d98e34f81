// SPDX-License-Identifier: MIT
#include "models/on_air.hpp"

namespace rovernet {

void OnAir::add(NodeId node, const Arrival& arrival, Time since) {
    if (node.index() >= first_.size()) first_.resize(node.index() + 1, none);
    std::uint32_t& first = first_[node.index()];
    while (first != none && entries_[first].arrival.end <= since) forget(first);
    std::uint32_t place = free_;
    if (place == none) {
        place = static_cast<std::uint32_t>(entries_.size());
        entries_.emplace_back();
    } else {
        free_ = entries_[place].next;
    }
    entries_[place] = {arrival, first};
    first = place;
}

void OnAir::forget(std::uint32_t& link) {
    const std::uint32_t place = link;
    link = entries_[place].next;
    entries_[place].next = free_;
    free_ = place;
}

}  // namespace rovernet
