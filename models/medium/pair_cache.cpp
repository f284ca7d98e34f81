// SPDX-License-Identifier: MIT
#include "models/medium/pair_cache.hpp"

namespace rovernet {

void PairCache::forget(NodeId node) {
    ++nodes_[node.index()].version;
    release(nodes_[node.index()]);
}

void PairCache::forget_all() {
    for (Node& node : nodes_) release(node);
}

void PairCache::release(Node& node) {
    pairs_ -= node.pairs.capacity();
    node.pairs = {};
}

void PairCache::make_room(NodeId node) {
    if (node.index() >= nodes_.size()) nodes_.resize(node.index() + 1);
}

Db PairCache::open(NodeId from, Db cutoff) {
    make_room(from);
    from_ = from;
    Node& mine = nodes_[from.index()];
    if (cutoff > mine.cutoff) mine.pairs.clear();
    if (mine.pairs.empty()) mine.cutoff = cutoff;
    // Values of `place` for other rows are harmless: find() checks which node is there.
    for (std::uint32_t i = 0; i < mine.pairs.size(); ++i) {
        nodes_[mine.pairs[i].to.index()].place = i;
    }
    return mine.cutoff;
}

bool PairCache::renew(std::size_t pairs) {
    Node& mine = nodes_[from_.index()];
    mine.pairs.clear();
    if (pairs <= mine.pairs.capacity()) return true;
    release(mine);
    if (pairs > most_pairs_ - pairs_) return false;
    mine.pairs.reserve(pairs);
    pairs_ += mine.pairs.capacity();
    return true;
}

void PairCache::keep(NodeId to, double loss_db) {
    make_room(to);
    nodes_[from_.index()].pairs.push_back({to, nodes_[to.index()].version, loss_db});
}

}  // namespace rovernet
