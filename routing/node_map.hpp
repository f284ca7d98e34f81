// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Map from nodes to values: a vector in the order of the nodes' ids. The index at which a node was
/// found last is tried first: it reads one cache line, where a binary search waits for several.
/// @tparam key  member of a value that is its node
template <class Value, NodeId Value::*key>
class NodeMap {
  public:
    /// Value of a node; null if there is none. The pointer is valid until the map changes.
    Value* find(NodeId node) {
        const std::size_t i = place(node);
        return i < values_.size() && values_[i].*key == node ? &values_[i] : nullptr;
    }
    /// Adds a value, whose node must not be in the map. @return reference to it, which is valid
    /// until the map changes
    Value& insert(const Value& value) {
        if (is_full()) values_.reserve(values_.size() + values_.size() / 8 + 4);
        return *values_.insert(values_.begin() + static_cast<std::ptrdiff_t>(place(value.*key)),
                               value);
    }
    void erase(NodeId node) {
        if (const Value* found = find(node))
            values_.erase(values_.begin() + (found - values_.data()));
    }
    template <class IsRemoved>
    void erase_if(IsRemoved is_removed) {
        std::erase_if(values_, is_removed);
    }
    void clear() { values_.clear(); }

    bool is_full() const { return values_.size() == values_.capacity(); }
    std::span<Value> values() { return values_; }
    std::span<const Value> values() const { return values_; }

    /// Fetches the value that find() tries first into the processor's cache.
    void prefetch(NodeId node) const {
        __builtin_prefetch(values_.data() + last_indices_[node.value % last_indices_.size()]);
    }

  private:
    // Index of the first value whose node is not below `node`.
    std::size_t place(NodeId node) {
        std::uint8_t& last = last_indices_[node.value % last_indices_.size()];
        if (last < values_.size() && values_[last].*key == node) return last;
        const auto found =
            std::lower_bound(values_.begin(), values_.end(), node,
                             [](const Value& each, NodeId wanted) { return each.*key < wanted; });
        const auto i = static_cast<std::size_t>(found - values_.begin());
        last = static_cast<std::uint8_t>(i);
        return i;
    }

    std::vector<Value> values_;
    // Index at which the last node of each remainder was found, modulo 256. It may have changed
    // since.
    std::array<std::uint8_t, 64> last_indices_{};
};

}  // namespace rovernet
