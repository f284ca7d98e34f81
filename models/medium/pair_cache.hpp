// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {

/// Path losses of pairs of nodes, kept while neither of them moves.
///
/// Of ordered pairs, since the transmitter's model rules. One row a transmitter: the receivers at
/// rest that were within its reach when it last found one that the row did not know. The row goes
/// when the transmitter's leg is replaced; a loss in it is void once the receiver's leg is. Who
/// rests is for the caller to say: a network in motion keeps nothing and pays nothing.
///
/// A row takes 16 bytes a pair. Once it holds as many pairs as it may, those that are kept stay
/// and others are not kept.
class PairCache {
  public:
    static constexpr std::size_t default_most_pairs = std::size_t{1} << 22;  ///< 64 MiB

    explicit PairCache(std::size_t most_pairs = default_most_pairs) : most_pairs_(most_pairs) {}

    /// The node's leg has been replaced: its losses are void.
    void moved(NodeId node) {
        if (node.index() < nodes_.size()) forget(node);
    }

    /// Makes find(), renew() and keep() be about a transmitter, which rests. Losses that were given
    /// up at less than `give_up` [dB] are void.
    /// @return [dB] at what the losses that will be kept may be given up; >= give_up
    Db open(NodeId from, Db give_up);
    /// The loss [dB] to `to`, which rests, or null. If it is more than open() returned it says no
    /// more than that.
    const double* find(NodeId to) const {
        if (to.index() >= nodes_.size()) return nullptr;
        const Node& node = nodes_[to.index()];
        const std::vector<Pair>& pairs = nodes_[from_.index()].pairs;
        if (node.place >= pairs.size() || pairs[node.place].to != to) return nullptr;
        const Pair& pair = pairs[node.place];
        return pair.version == node.version ? &pair.loss_db : nullptr;
    }
    /// Empties the row, for so many pairs; false if that is more than there is room for.
    bool renew(std::size_t pairs);
    /// Adds a pair to the renewed row; `to` rests, and is not in the row.
    void keep(NodeId to, double loss_db);

    std::size_t pairs() const { return pairs_; }  ///< that there is memory for now

  private:
    struct Pair {
        NodeId to;
        std::uint32_t version;  // of `to` at that time
        double loss_db;
    };
    struct Node {
        std::uint32_t version = 0;  // counts its legs
        std::uint32_t place = 0;    // in the open row, if it is the one who is there
        std::vector<Pair> pairs = {};
        Db give_up{};  // at which all of them may have been given up
    };

    void forget(NodeId node);
    void release(Node& node);
    void make_room(NodeId node);

    std::size_t most_pairs_;
    std::size_t pairs_ = 0;
    NodeId from_{};
    std::vector<Node> nodes_;
};

}  // namespace rovernet
