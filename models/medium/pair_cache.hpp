// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

// Losses of robots at rest, for models that are costly to ask: a ray through a map.

namespace rovernet {

/// Path losses of pairs of nodes, kept while neither of them moves.
///
/// Pairs are ordered, since the transmitter's model rules. Each transmitter has a row: the
/// receivers at rest that were within its reach when it last found one that the row did not know.
/// The row goes when the transmitter's leg is replaced; a loss in it is void once the receiver's
/// leg is. Who rests is for the caller to say: a network in motion keeps nothing and pays nothing.
///
/// A row takes 16 bytes a pair. Once the cache holds as many pairs as it may, those that are kept
/// stay and others are not kept. Candidates use it, for one transmitter at a time:
///
///   open(from)                 find(to) for each receiver at rest
///   renew(n), keep(to, loss)   if one was not found
class PairCache {
  public:
    /// Pairs that it may hold by default: 64 MiB.
    static constexpr std::size_t default_most_pairs = std::size_t{1} << 22;

    /// @param most_pairs  pairs that it may hold
    explicit PairCache(std::size_t most_pairs = default_most_pairs) : most_pairs_(most_pairs) {}

    /// Takes note that the node's leg has been replaced: its losses are void.
    void moved(NodeId node) {
        if (node.index() < nodes_.size()) forget(node);
    }
    /// Forgets all losses: the scene between the nodes has changed.
    void forget_all();

    /// Makes find(), renew() and keep() be about a transmitter, which rests. Discards losses that
    /// were computed with a smaller cut-off than `give_up` [dB].
    /// @return cut-off [dB] for losses that are stored from now on; >= give_up
    Db open(NodeId from, Db give_up);
    /// Loss [dB] to `to`, which rests, or null. If it is more than open() returned it says no more
    /// than that.
    const double* find(NodeId to) const {
        if (to.index() >= nodes_.size()) return nullptr;
        const Node& node = nodes_[to.index()];
        const std::vector<Pair>& pairs = nodes_[from_.index()].pairs;
        if (node.place >= pairs.size() || pairs[node.place].to != to) return nullptr;
        const Pair& pair = pairs[node.place];
        return pair.version == node.version ? &pair.loss_db : nullptr;
    }
    /// Empties the row, for so many pairs. @return false if that is more than there is room for
    bool renew(std::size_t pairs);
    /// Adds a pair to the renewed row; `to` rests, and is not in the row.
    void keep(NodeId to, double loss_db);

    /// Pairs that there is memory for now.
    std::size_t pairs() const { return pairs_; }

  private:
    // Receiver in a row, and the loss to it.
    struct Pair {
        NodeId to;
        /// Version of the receiver's leg at that time.
        std::uint32_t version;
        double loss_db;
    };
    // Row of a node as transmitter, and its state as receiver.
    struct Node {
        /// Number of its legs so far.
        std::uint32_t version = 0;
        /// Place in the open row, if it is the node that is there.
        std::uint32_t place = 0;
        std::vector<Pair> pairs = {};
        /// Cut-off at which the losses of the row may have been given up.
        Db give_up{};
    };

    // Discards the row of a node, and makes its losses in other rows void.
    void forget(NodeId node);
    // Gives back the memory of a row.
    void release(Node& node);
    // Makes room for what is known of a node.
    void make_room(NodeId node);

    // Pairs that it may hold, and that it has memory for.
    std::size_t most_pairs_;
    std::size_t pairs_ = 0;
    // Transmitter that the cache is open for.
    NodeId from_{};
    // Rows by node, up to the last that has one or was moved.
    std::vector<Node> nodes_;
};

}  // namespace rovernet
