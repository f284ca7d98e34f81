// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace rovernet::dsr {

/// Path of a route: its nodes in order, with both ends; at most sixteen, as in ns-2 and ns-3.
class Path {
  public:
    static constexpr std::size_t longest = 16;

    Path() = default;
    Path(std::initializer_list<NodeId> nodes) {
        for (const NodeId node : nodes) add(node);
    }
    explicit Path(std::span<const NodeId> nodes) {
        for (const NodeId node : nodes) add(node);
    }

    void add(NodeId node) {
        assert(size_ < longest);
        nodes_[size_++] = node;
    }
    void truncate(std::size_t size) { size_ = static_cast<std::uint8_t>(size); }

    std::size_t size() const { return size_; }
    std::size_t hops() const { return size_ - 1U; }
    bool is_full() const { return size_ == longest; }
    NodeId operator[](std::size_t i) const { return nodes_[i]; }
    NodeId front() const { return nodes_[0]; }
    NodeId back() const { return nodes_[size_ - 1U]; }
    const NodeId* begin() const { return nodes_.data(); }
    const NodeId* end() const { return nodes_.data() + size_; }

    /// Index of a node in the path, from 0; size() if the node is not in the path.
    std::size_t place(NodeId node) const {
        return static_cast<std::size_t>(std::find(begin(), end(), node) - begin());
    }
    bool has(NodeId node) const { return place(node) < size(); }
    bool starts_with(const Path& other) const {
        // The last node is compared first, because it differs most often.
        return other.size_ <= size_ && nodes_[other.size_ - 1U] == other.back() &&
               std::equal(other.begin(), other.end(), begin());
    }
    /// Path of the first `size` nodes; and path of the nodes from index `from` on (index from 0).
    Path first(std::size_t size) const { return Path(std::span(begin(), size)); }
    Path from(std::size_t from) const { return Path(std::span(begin() + from, end())); }
    Path reversed() const {
        Path back = *this;
        std::reverse(back.nodes_.begin(), back.nodes_.begin() + back.size_);
        return back;
    }
    friend bool operator==(const Path& a, const Path& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

  private:
    std::array<NodeId, longest> nodes_{};
    std::uint8_t size_ = 0;
};

}  // namespace rovernet::dsr
