// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

// Cache of path losses between robots at rest, for costly models such as ray tracing on a map.

namespace rovernet {

/// Path losses of pairs of nodes, kept while both nodes rest.
///
/// Pairs are ordered (transmitter, receiver), because the transmitter's model applies. Each
/// transmitter has a row: the receivers at rest that were within its reach when the row was last
/// renewed. The row is removed when the transmitter's leg is replaced. A loss in the row becomes
/// invalid when the receiver's leg is replaced. The caller determines which nodes rest: while all
/// nodes move, nothing is stored.
///
/// A row takes 16 bytes per pair. Once the cache is full, stored pairs remain and further pairs are
/// not stored. Candidates use the cache, for one transmitter at a time:
///
///   open(from)                 find(to) for each receiver at rest
///   renew(n), keep(to, loss)   if a receiver was not found
class PairCache {
  public:
    /// Default limit of the number of stored pairs, which take 64 MiB.
    static constexpr std::size_t default_most_pairs = std::size_t{1} << 22;

    /// @param most_pairs  largest number of stored pairs
    explicit PairCache(std::size_t most_pairs = default_most_pairs) : most_pairs_(most_pairs) {}

    /// Discards the losses from and to the node after its leg was replaced.
    void moved(NodeId node) {
        if (node.index() < nodes_.size()) forget(node);
    }
    /// Discards all losses after a scene change.
    void forget_all();

    /// Selects a transmitter at rest for find(), renew() and keep(). Discards losses that were
    /// computed with a smaller cut-off than `cutoff` [dB].
    /// @return cut-off [dB] for losses stored from now on; >= cutoff
    Db open(NodeId from, Db cutoff);
    /// Path loss [dB] from the selected transmitter to `to`, which must rest; null if not stored. A
    /// loss above the result of open() is only a lower bound.
    const double* find(NodeId to) const {
        if (to.index() >= nodes_.size()) return nullptr;
        const Node& node = nodes_[to.index()];
        const std::vector<Pair>& pairs = nodes_[from_.index()].pairs;
        if (node.place >= pairs.size() || pairs[node.place].to != to) return nullptr;
        const Pair& pair = pairs[node.place];
        return pair.version == node.version ? &pair.loss_db : nullptr;
    }
    /// Removes the losses of the selected transmitter, and reserves space for `pairs` receivers.
    /// @return false if there is not enough space
    bool renew(std::size_t pairs);
    /// Stores the loss [dB] from the selected transmitter to `to`, which must rest. Must follow
    /// renew(), once for each receiver.
    void keep(NodeId to, double loss_db);

    /// Number of pairs for which memory is allocated.
    std::size_t pairs() const { return pairs_; }

  private:
    // Receiver in a transmitter's row, and the path loss [dB] to the receiver.
    struct Pair {
        NodeId to;
        /// Number of the receiver's leg for which the loss was computed.
        std::uint32_t version;
        double loss_db;
    };
    // Data of one node: its row of receivers, for frames that it transmits; and its leg number, for
    // losses from other nodes to it.
    struct Node {
        /// Number of legs of the node so far.
        std::uint32_t version = 0;
        /// Index in the row of the selected transmitter; valid only if the receiver stored there is
        /// this node.
        std::uint32_t place = 0;
        std::vector<Pair> pairs = {};
        /// Cut-off [dB] of the losses from this transmitter: larger losses are only lower bounds.
        Db cutoff{};
    };

    // Discards the row of a node, and invalidates the losses to the node in other rows.
    void forget(NodeId node);
    // Frees the memory of a row.
    void release(Node& node);
    // Allocates the state of a node.
    void make_room(NodeId node);

    // Largest number of pairs, and number of pairs for which memory is allocated.
    std::size_t most_pairs_;
    std::size_t pairs_ = 0;
    // Transmitter selected by open().
    NodeId from_{};
    // Rows by node, up to the last node that has a row or has moved.
    std::vector<Node> nodes_;
};

}  // namespace rovernet
