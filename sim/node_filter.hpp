// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rovernet {

/// Which nodes may be in a small set: those that are, and a few that are not. Eight kilobytes,
/// whatever the number of nodes (a Bloom filter with one hash function: the id).
class NodeFilter {
  public:
    void add(NodeId node) { words_[place(node)] |= std::uint64_t{1} << node.index() % 64; }
    /// Takes a node out again; those that were added with it must follow before any is asked for.
    void remove(NodeId node) { words_[place(node)] = 0; }
    bool may_have(NodeId node) const { return words_[place(node)] >> node.index() % 64 & 1; }

  private:
    static constexpr std::size_t words = 1024;

    static std::size_t place(NodeId node) { return node.index() / 64 % words; }

    std::array<std::uint64_t, words> words_{};
};

}  // namespace rovernet
